#include "drivers/replay/stamped_time.h"

#include <chrono>

#include <gtest/gtest.h>

#include "drivers/replay/field_time.h"

namespace tubesight::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::int64_t kMillisecond = 1000;  // units a second

FrameStamp in_ms(std::int64_t ticks) { return {ticks, 1, kMillisecond}; }

TEST(StampedTime, KeepsAnEvenRateEvenWhereStampsAreRounded) {
  StampedTime time;
  time.begin(30'000, 1001);  // every 33.3666 ms
  for (int frame = 0; frame < 300; ++frame) {
    // As Matroska rounds: to the nearest millisecond, from an origin of its own.
    time.place(in_ms(500 + (frame * 1001 * 1000 + 15'000) / 30'000));

    ASSERT_EQ(time.time(false), nominal_field_time(2 * frame, 30'000, 1001)) << frame;
    ASSERT_EQ(time.time(true), nominal_field_time(2 * frame + 1, 30'000, 1001)) << frame;
  }
}

TEST(StampedTime, ShowsWhereFramesAreMissing) {
  StampedTime time;
  time.begin(25, 1);
  time.place(in_ms(0));
  time.place(in_ms(40));
  time.place(in_ms(160));

  EXPECT_EQ(time.time(false), milliseconds(160));
  EXPECT_EQ(time.time(true), milliseconds(180));
}

TEST(StampedTime, TakesAVariableRateAsItIs) {
  StampedTime time;
  time.begin(25, 1);
  time.place(in_ms(1000));
  time.place(in_ms(1055));

  EXPECT_EQ(time.time(false), milliseconds(55));
  EXPECT_EQ(time.time(true), milliseconds(75));
}

TEST(StampedTime, CountsAPeriodWhereThereIsNoStamp) {
  StampedTime time;
  time.begin(25, 1);
  time.place(std::nullopt);
  EXPECT_EQ(time.time(false), milliseconds(0));
  time.place(in_ms(7));
  EXPECT_EQ(time.time(false), milliseconds(40));
  time.place(std::nullopt);
  EXPECT_EQ(time.time(false), milliseconds(80));
}

/// The tracking is told, and refuses such a field.
TEST(StampedTime, LetsTimeRunBackwards) {
  StampedTime time;
  time.begin(25, 1);
  time.place(in_ms(100));
  time.place(in_ms(40));

  EXPECT_EQ(time.time(false), milliseconds(-60));
}

TEST(StampedTime, OutlivesWildStamps) {
  StampedTime time;
  time.begin(25, 1);
  time.place(FrameStamp{-9'000'000'000'000'000'000, 1, 1'000'000'000});
  time.place(FrameStamp{9'000'000'000'000'000'000, 1, 1'000'000'000});
  EXPECT_EQ(time.time(false), milliseconds(40));
  time.place(FrameStamp{1, 2, 3});  // another unit
  EXPECT_EQ(time.time(false), milliseconds(80));
  time.begin(1'000'000'000, 1);
  time.place(FrameStamp{0, 1, 1});
  time.place(FrameStamp{3'000'000'000, 1, 1});
  EXPECT_EQ(time.time(false), nanoseconds(3'000'000'000'000'000'000));
}

}  // namespace
}  // namespace tubesight::drivers
