#include "core/tracking/field_cadence.h"

#include <array>
#include <cstdlib>

#include <gtest/gtest.h>

namespace tubesight::core::tracking {
namespace {

using Stamp = FieldCadence::Stamp;

constexpr std::int64_t kPeriod_ns = 16'683'350;
// As far as five milliseconds, in an order of no pattern.
constexpr std::array<std::int64_t, 16> kWaver_us = {1200,  -4900, 3300, 5000, -2100, -4400,
                                                    400,   2800,  -800, 4700, -5000, 1900,
                                                    -3600, 4100,  -300, -1700};

/// A cadence that is shown fields `numbers` apart.
class FieldCadenceOf : public ::testing::Test {
 protected:
  Stamp show(std::int64_t number, std::int64_t off_us = 0) {
    const FieldTime stamp(number * kPeriod_ns + off_us * 1000);
    const Stamp told = cadence_.judge(stamp, number - last_);
    cadence_.follow(stamp, number - last_);
    last_ = number;
    return told;
  }
  Stamp show_wavering(std::int64_t number) {
    return show(number, kWaver_us[static_cast<std::size_t>(number) % kWaver_us.size()]);
  }

  FieldCadence cadence_;
  std::int64_t last_ = 0;
};

TEST_F(FieldCadenceOf, TellsNothingOfTheFirstFields) {
  for (std::int64_t number = 0; number < 4; ++number) {
    EXPECT_EQ(show(number), Stamp::kAlone) << number;
  }
  EXPECT_EQ(show(4), Stamp::kExact);
}

TEST_F(FieldCadenceOf, FindsThePeriodOfWaveringStamps) {
  for (std::int64_t number = 0; number < 200; ++number) {
    const Stamp told = show_wavering(number);
    if (number > 8) {
      ASSERT_NE(told, Stamp::kAlone) << number;
      EXPECT_NEAR(static_cast<double>(cadence_.time_of(1).count()), 1.0 * kPeriod_ns,
                  number < 40 ? 1.2e6 : 0.3e6)
          << number;
    }
  }
}

TEST_F(FieldCadenceOf, FindsAFieldLeftOutWithoutANumberUnderWaveringStamps) {
  for (std::int64_t number = 0; number < 60; ++number) {
    static_cast<void>(show_wavering(number));
  }
  last_ += 1;  // the counter goes on by one, two fields' time passes
  EXPECT_EQ(show(61), Stamp::kAlone);
}

TEST_F(FieldCadenceOf, FollowsABeatThatMoved) {
  for (std::int64_t number = 0; number < 60; ++number) {
    static_cast<void>(show(number));
  }
  EXPECT_EQ(show(60, 30'000), Stamp::kAlone);
  EXPECT_EQ(show(61, 30'000), Stamp::kAlone) << "the first might have been a stamp far off";
  EXPECT_EQ(show(62, 30'000), Stamp::kExact);
}

TEST_F(FieldCadenceOf, IsNotMovedByOneStampFarOff) {
  for (std::int64_t number = 0; number < 60; ++number) {
    static_cast<void>(show(number));
  }
  EXPECT_EQ(show(60, 14'000), Stamp::kAlone);
  EXPECT_EQ(show(61), Stamp::kExact);
}

TEST_F(FieldCadenceOf, CountsNumbersThatAreMissing) {
  for (std::int64_t number = 0; number < 60; ++number) {
    static_cast<void>(show_wavering(number));
  }
  EXPECT_EQ(show(65, 4000), Stamp::kWavers);
  EXPECT_NEAR(static_cast<double>(cadence_.time_of(5).count()), 5.0 * kPeriod_ns, 2e6);
}

TEST_F(FieldCadenceOf, TakesNumbersThatGrowByTwo) {
  for (std::int64_t number = 0; number < 40; number += 2) {
    static_cast<void>(show(number));
  }
  EXPECT_EQ(show(40, 2000), Stamp::kWavers);
  EXPECT_EQ(cadence_.step(), 2);
}

TEST_F(FieldCadenceOf, LearnsANewRate) {
  for (std::int64_t number = 0; number < 60; ++number) {
    static_cast<void>(show(number));
  }
  std::int64_t at_ns = 59 * kPeriod_ns;
  Stamp told = Stamp::kAlone;
  for (int i = 0; i < 30; ++i) {
    at_ns += 40'000'000;
    told = cadence_.judge(FieldTime(at_ns), 1);
    cadence_.follow(FieldTime(at_ns), 1);
  }
  EXPECT_EQ(told, Stamp::kExact);
  EXPECT_NEAR(static_cast<double>(cadence_.time_of(1).count()), 40e6, 1e5);
}

TEST_F(FieldCadenceOf, KnowsNoBeatWithoutNumbers) {
  for (std::int64_t i = 0; i < 20; ++i) {
    EXPECT_EQ(cadence_.judge(FieldTime(i * kPeriod_ns), 0), Stamp::kAlone);
    cadence_.follow(FieldTime(i * kPeriod_ns), 0);
  }
}

}  // namespace
}  // namespace tubesight::core::tracking
