#include "drivers/replay/field_time.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(NominalFieldTime, HalvesAFrame) {
  EXPECT_EQ(nominal_field_time(0, 30, 1).count(), 0);
  EXPECT_EQ(nominal_field_time(1, 30, 1).count(), 16666667);  // 16666666.67
  EXPECT_EQ(nominal_field_time(2, 30, 1).count(), 33333333);  // 33333333.33
  EXPECT_EQ(nominal_field_time(1, 25, 1).count(), 20000000);
  EXPECT_EQ(nominal_field_time(185, 30, 1).count(), 3083333333);
}

TEST(NominalFieldTime, RoundsHalfUp) {
  // 1 / (2 * 10^9) s is half a nanosecond.
  EXPECT_EQ(nominal_field_time(1, 1000000000, 1).count(), 1);
  EXPECT_EQ(nominal_field_time(3, 1000000000, 1).count(), 2);
}

TEST(NominalFieldTime, KeepsTheFractionOfNtsc) {
  // 1001 / 60000 s = 16683333.33 ns; after 10^6 fields 16683.333333333 s.
  EXPECT_EQ(nominal_field_time(1, 30000, 1001).count(), 16683333);
  EXPECT_EQ(nominal_field_time(1000000, 30000, 1001).count(), 16683333333333);
}

TEST(NominalFieldTime, HoldsAtTheEndOfTime) {
  const auto last = nominal_field_time(std::int64_t{1} << 33, 1, 1000000000).count();

  EXPECT_GT(last, 9'200'000'000'000'000'000);
}

}  // namespace
}  // namespace tubesight::drivers
