#include "core/kinematics/speed_profile.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace tubesight::core::kinematics {
namespace {

struct Row {
  double time_s;
  double distance;
  double speed;
  double acceleration;
};

template <std::size_t N>
void expect_rows(const SpeedProfile& profile, const Row (&rows)[N]) {
  for (const Row& row : rows) {
    const ProfilePoint point = profile.at(row.time_s);
    EXPECT_NEAR(point.distance, row.distance, 1e-12 * (1.0 + row.distance)) << row.time_s;
    EXPECT_NEAR(point.speed, row.speed, 1e-12 * (1.0 + row.speed)) << row.time_s;
    EXPECT_NEAR(point.acceleration, row.acceleration, 1e-11) << row.time_s;
  }
}

SpeedProfile made(double length, SpeedShape shape, const SpeedLimits& limits) {
  const auto profile = SpeedProfile::make(length, shape, limits);
  EXPECT_TRUE(profile);
  return profile.value_or({});
}

TEST(SpeedProfile, FollowsATrapezoidWorkedOutByHand) {
  // 0.5 s to 50 mm/s over 12.5 mm, 75 mm at 50 mm/s, 0.5 s to rest.
  const SpeedProfile profile = made(100.0, SpeedShape::kTrapezoid, {50.0, 100.0, 0.0});

  EXPECT_DOUBLE_EQ(profile.duration_s(), 2.5);
  EXPECT_DOUBLE_EQ(profile.peak_speed(), 50.0);
  expect_rows(profile, {{-1.0, 0.0, 0.0, 0.0},
                        {0.25, 3.125, 25.0, 100.0},
                        {0.5, 12.5, 50.0, 0.0},
                        {1.0, 37.5, 50.0, 0.0},
                        {2.25, 96.875, 25.0, -100.0},
                        {2.5, 100.0, 0.0, 0.0},
                        {9.0, 100.0, 0.0, 0.0}});
}

TEST(SpeedProfile, AShortTrapezoidIsATriangle) {
  const SpeedProfile profile = made(4.0, SpeedShape::kTrapezoid, {50.0, 100.0, 0.0});

  EXPECT_DOUBLE_EQ(profile.duration_s(), 0.4);
  EXPECT_DOUBLE_EQ(profile.peak_speed(), 20.0);
  expect_rows(profile, {{0.1, 0.5, 10.0, 100.0}, {0.3, 3.5, 10.0, -100.0}});
}

TEST(SpeedProfile, FollowsAnSCurveOfSevenStretchesWorkedOutByHand) {
  // Jerk 5 for 2 s (20/3 mm, 10 mm/s), 2 s at 10 mm/s², 2 s back: 120 mm, 40 mm/s. 19 s cruise.
  const SpeedProfile profile = made(1000.0, SpeedShape::kSCurve, {40.0, 10.0, 5.0});

  EXPECT_DOUBLE_EQ(profile.duration_s(), 31.0);
  EXPECT_DOUBLE_EQ(profile.peak_speed(), 40.0);
  EXPECT_DOUBLE_EQ(profile.peak_acceleration(), 10.0);
  expect_rows(profile, {{1.0, 5.0 / 6.0, 2.5, 5.0},
                        {2.0, 20.0 / 3.0, 10.0, 10.0},
                        {3.0, 65.0 / 3.0, 20.0, 10.0},
                        {5.0, 120.0 - 40.0 + 5.0 / 6.0, 37.5, 5.0},
                        {6.0, 120.0, 40.0, 0.0},
                        {15.5, 500.0, 40.0, 0.0},
                        {30.0, 1000.0 - 5.0 / 6.0, 2.5, -5.0},
                        {31.0, 1000.0, 0.0, 0.0}});
}

TEST(SpeedProfile, AnSCurveTooShortToCruiseLowersItsPeak) {
  // 3 s of full acceleration's ramp and 2 s of jerk to 30 mm/s: 75 mm, and the same again.
  const SpeedProfile profile = made(150.0, SpeedShape::kSCurve, {1000.0, 10.0, 5.0});

  EXPECT_NEAR(profile.peak_speed(), 30.0, 1e-12);
  EXPECT_NEAR(profile.duration_s(), 10.0, 1e-12);
  expect_rows(profile, {{2.0, 20.0 / 3.0, 10.0, 10.0}, {4.999999999, 75.0 - 3e-8, 30.0, 5e-9}});
}

TEST(SpeedProfile, AVeryShortSCurveReachesNoFullAcceleration) {
  // 1 s of jerk 5 and 1 s back: 5 mm/s after 5 mm.
  const SpeedProfile profile = made(10.0, SpeedShape::kSCurve, {1000.0, 10.0, 5.0});

  EXPECT_NEAR(profile.peak_speed(), 5.0, 1e-12);
  EXPECT_NEAR(profile.peak_acceleration(), 5.0, 1e-12);
  EXPECT_NEAR(profile.duration_s(), 4.0, 1e-12);
  expect_rows(profile, {{1.0, 5.0 / 6.0, 2.5, 5.0}, {3.5, 10.0 - 5.0 / 48.0, 0.625, -2.5}});
}

TEST(SpeedProfile, ASlowSCurveCruisesWithoutFullAcceleration) {
  // To 5 mm/s as above in 2 s over 5 mm, then 90 mm at 5 mm/s.
  const SpeedProfile profile = made(100.0, SpeedShape::kSCurve, {5.0, 10.0, 5.0});

  EXPECT_NEAR(profile.duration_s(), 22.0, 1e-12);
  EXPECT_NEAR(profile.peak_acceleration(), 5.0, 1e-12);
  expect_rows(profile, {{2.0, 5.0, 5.0, 0.0}, {11.0, 50.0, 5.0, 0.0}});
}

TEST(SpeedProfile, NoLengthTakesNoTime) {
  for (const SpeedShape shape : {SpeedShape::kTrapezoid, SpeedShape::kSCurve}) {
    const SpeedProfile profile = made(0.0, shape, {50.0, 100.0, 1000.0});

    EXPECT_EQ(profile.duration_s(), 0.0);
    EXPECT_EQ(profile.at(0.0).distance, 0.0);
    EXPECT_EQ(profile.at(0.0).speed, 0.0);
  }
}

TEST(SpeedProfile, RefusesWhatNothingCanMoveBy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const auto refused = [](double length, const SpeedLimits& limits) {
    const auto profile = SpeedProfile::make(length, SpeedShape::kSCurve, limits);
    return !profile && profile.error() == Error::kInvalidArgument;
  };

  EXPECT_TRUE(refused(-1.0, {1.0, 1.0, 1.0}));
  EXPECT_TRUE(refused(nan, {1.0, 1.0, 1.0}));
  EXPECT_TRUE(refused(infinite, {1.0, 1.0, 1.0}));
  EXPECT_TRUE(refused(1.0, {0.0, 1.0, 1.0}));
  EXPECT_TRUE(refused(1.0, {1.0, -1.0, 1.0}));
  EXPECT_TRUE(refused(1.0, {1.0, 1.0, 0.0}));
  EXPECT_TRUE(refused(1.0, {1.0, nan, 1.0}));
  EXPECT_TRUE(refused(2e9, {1.0, 1.0, 1.0}));
  EXPECT_TRUE(refused(1.0, {1e-10, 1.0, 1.0}));
  EXPECT_TRUE(SpeedProfile::make(1.0, SpeedShape::kTrapezoid, {1.0, 1.0, 0.0}))
      << "a trapezoid knows no jerk";
}

TEST(SpeedProfile, IsSoundAtTheEndsOfItsRange) {
  for (const double length : {1e-31, 1e-29, 1e-9, 1.0, 1e9}) {
    for (const double speed : {1e-9, 1e9}) {
      for (const double acceleration : {1e-9, 1e9}) {
        for (const double jerk : {1e-9, 1e9}) {
          const SpeedLimits limits{speed, acceleration, jerk};
          const SpeedProfile profile = made(length, SpeedShape::kSCurve, limits);
          const ProfilePoint half = profile.at(0.5 * profile.duration_s());
          if (length > 1e-30) {
            EXPECT_NEAR(half.distance / length, 0.5, 1e-9) << speed << ' ' << acceleration;
            EXPECT_LE(profile.peak_acceleration(), acceleration);
            EXPECT_LE(profile.peak_speed(), speed);
          } else {
            EXPECT_EQ(profile.duration_s(), 0.0);
          }
        }
      }
    }
  }
}

// Walks the whole profile: within the limits, and each number the rate of the one before.
void expect_consistent(const SpeedProfile& profile, const SpeedLimits& limits, bool s_curve) {
  constexpr int kSteps = 2000;
  const double step_s = profile.duration_s() / kSteps;
  const double jerk = s_curve ? limits.jerk : 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const ProfilePoint a = profile.at(i * step_s);
    const ProfilePoint b = profile.at((i + 1) * step_s);
    ASSERT_LE(a.speed, limits.speed * (1.0 + 1e-12));
    ASSERT_LE(std::abs(a.acceleration), limits.acceleration * (1.0 + 1e-12));
    ASSERT_GE(b.distance, a.distance - 1e-12 * profile.length());
    // A trapezoid's acceleration may jump within a step.
    const double slack = s_curve ? 0.25 * jerk * step_s * step_s : limits.acceleration * step_s;
    ASSERT_NEAR(b.distance - a.distance, 0.5 * (a.speed + b.speed) * step_s,
                slack * step_s + 1e-9 * profile.length());
    if (s_curve) {
      ASSERT_LE(std::abs(b.acceleration - a.acceleration), jerk * step_s * (1.0 + 1e-6));
      ASSERT_NEAR(b.speed - a.speed, 0.5 * (a.acceleration + b.acceleration) * step_s,
                  slack + 1e-9 * limits.speed);
    }
  }
}

TEST(SpeedProfile, KeepsTheLimitsAndIsContinuousWhateverTheyAre) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-2.0, 2.0);
  for (int i = 0; i < 200; ++i) {
    const bool s_curve = i % 2 == 0;
    const SpeedLimits limits{100.0 * std::pow(10.0, exponent(random)),
                             1000.0 * std::pow(10.0, exponent(random)),
                             10000.0 * std::pow(10.0, exponent(random))};
    const double length = 30.0 * std::pow(10.0, exponent(random));
    const auto profile =
        SpeedProfile::make(length, s_curve ? SpeedShape::kSCurve : SpeedShape::kTrapezoid, limits);
    ASSERT_TRUE(profile);

    SCOPED_TRACE(testing::Message() << "seed 1, number " << i);
    expect_consistent(*profile, limits, s_curve);
    // Something is at its limit, or a shorter time would do.
    const bool fast = profile->peak_speed() > limits.speed * (1.0 - 1e-9);
    const bool hard = profile->peak_acceleration() > limits.acceleration * (1.0 - 1e-9);
    EXPECT_TRUE(fast || hard || (s_curve && profile->peak_acceleration() < limits.acceleration));
    if (HasFatalFailure()) {
      return;
    }
  }
}

}  // namespace
}  // namespace tubesight::core::kinematics
