#include "board/bench/reconcile/utc_time.h"

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

TEST(UtcTime, ReadsWhatItWrites) {
  for (const char* const text :
       {"1970-01-01T00:00:00.000Z", "2026-12-01T03:04:05.678Z", "2028-02-29T23:59:59.999Z"}) {
    const auto time = parse_utc(text);
    ASSERT_TRUE(time) << text;
    EXPECT_EQ(utc_text(*time), text);
  }
  EXPECT_EQ(parse_utc("2026-12-01T03:04:05Z")->time_since_epoch().count(), 1'796'094'245'000);
}

TEST(UtcTime, TakesWhatPeopleWrite) {
  const auto time = parse_utc("2026-12-01T03:04:05.500Z");
  EXPECT_EQ(parse_utc("2026-12-01 03:04:05.5"), time);
  EXPECT_EQ(parse_utc("2026-12-01T03:04:05.50"), time);
}

TEST(UtcTime, RefusesAllElse) {
  for (const char* const text :
       {"", "2026-12-01", "2026-12-01T03:04", "2026-13-01T03:04:05Z", "2026-02-29T03:04:05Z",
        "2026-12-01T24:04:05Z", "2026-12-01T03:60:05Z", "2026-12-01T03:04:60Z",
        "2026-12-01T03:04:05+01:00", "2026-12-01T03:04:05.Z", "2026-12-01T03:04:05.1234Z",
        "1.12.2026 03:04:05", "1969-12-31T23:59:59Z", "2026-12-01T03:04:05Z "}) {
    EXPECT_FALSE(parse_utc(text)) << text;
  }
}

}  // namespace
}  // namespace tubesight::board
