#include "core/tracking/motion.h"

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

template <typename S>
class MotionOf : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_.settings->motion = {300.0, 3000.0};
    scene_.make();
  }

  Scene<S> scene_;
};
TYPED_TEST_SUITE(MotionOf, Scalars);

TYPED_TEST(MotionOf, CountsSecondsWithinOne) {
  EXPECT_NEAR(number(seconds<TypeParam>(microseconds(16667))), 0.016667, 1e-8);
  EXPECT_EQ(number(seconds<TypeParam>(milliseconds(250))), 0.25);
  EXPECT_EQ(number(seconds<TypeParam>(milliseconds(-5))), 0.0);
  EXPECT_EQ(number(seconds<TypeParam>(std::chrono::hours(3))), 1.0);
}

TYPED_TEST(MotionOf, ReachesAsFarAsAccelerationTakesIt) {
  // 3000 mm/s^2 * 0.02 s * (0.02 s + 0.02 s) / 2 = 1.2 mm.
  Motion<TypeParam> motion;
  motion.known = true;
  motion.interval_s = Unit<TypeParam>(0.02);
  const auto span = Unit<TypeParam>(0.02);
  // Fixed point writes the interval in steps of 1e-6 s.
  EXPECT_NEAR(number(reachable_mm<TypeParam>(this->scene_.model, motion, span, {})), 1.2, 1e-4);

  // 0.06 s after such an interval: 3000 * 0.06 * 0.08 / 2 = 7.2 mm.
  EXPECT_NEAR(
      number(reachable_mm<TypeParam>(this->scene_.model, motion, Unit<TypeParam>(0.06), {})), 7.2,
      1e-4);
}

TYPED_TEST(MotionOf, ReachesNoFartherThanFromOneGreatestSpeedToTheOther) {
  // After 0.5 s acceleration would allow 390 mm; from +300 to -300 mm/s it is 300 mm.
  Motion<TypeParam> motion;
  motion.known = true;
  motion.interval_s = Unit<TypeParam>(0.02);
  EXPECT_NEAR(number(reachable_mm<TypeParam>(this->scene_.model, motion, Unit<TypeParam>(0.5), {})),
              300.0, 1e-3);
}

TYPED_TEST(MotionOf, IsAtMostTheGreatestSpeedsWayWhenUnknown) {
  const Motion<TypeParam> unknown;
  // 300 mm/s * 0.02 s.
  const auto reach = [&](double span) {
    return number(reachable_mm<TypeParam>(this->scene_.model, unknown, Unit<TypeParam>(span), {}));
  };
  EXPECT_NEAR(reach(0.02), 6.0, 1e-4);
  for (const double span : {0.03, 0.05, 0.08}) {
    EXPECT_LE(reach(span), std::min(300.0 * span, 0.4 * 25.4) + 1e-3) << span;
  }
  // A tool at rest when clicked can have gone 1500 mm/s^2 * 0.1 s * 0.1 s = 15 mm since, to another
  // tube: beyond the limit, which ends the track.
  EXPECT_NEAR(reach(0.1), 15.0, 1e-3);
}

TYPED_TEST(MotionOf, LeavesNoDeadZoneOfSpeedsRightAfterAStart) {
  // A place as good as tracking needs later is good enough at once, whatever the top speed; and
  // what is found within the reach cannot be a neighbour: to look like it, the tool must have gone
  // a step less the reach, less six deviations, which is farther than the greatest speed takes it.
  constexpr double kStep_mm = 25.4;
  const Motion<TypeParam> unknown;
  for (double share = 0.1; share < 1.6; share += 0.02) {
    constexpr double kSpan_s = 1.0 / 30.0;
    this->scene_.settings->motion = {share * kStep_mm / kSpan_s, 3000.0};
    this->scene_.make();
    const double limit = number(address_limit_mm<TypeParam>(this->scene_.model));
    EXPECT_NEAR(limit, 0.4 * kStep_mm, 0.02);
    for (const double deviation : {0.0, 0.1, 0.25, 0.5, 1.0, 2.0, 2.7}) {
      const double reach = number(reachable_mm<TypeParam>(
          this->scene_.model, unknown, Unit<TypeParam>(kSpan_s), Mm<TypeParam>(deviation)));
      if (reach > std::min(share * kStep_mm, 1500.0 * kSpan_s * kSpan_s) + 1e-3) {
        EXPECT_LT(reach + 3.0 * deviation, limit) << share << ", " << deviation;
      }
      EXPECT_LE(reach + 3.0 * deviation, limit + 1e-3) << share << ", " << deviation;
      const double at_rest = std::min(share * kStep_mm, 1500.0 * kSpan_s * kSpan_s);
      EXPECT_GE(reach, at_rest - 1e-3) << share << ", " << deviation;
      if (reach > at_rest + 1e-3) {
        EXPECT_LE(share * kStep_mm, kStep_mm - reach - 6.0 * deviation + 1e-2)
            << share << ", " << deviation;
      }
    }
  }
}

TYPED_TEST(MotionOf, PredictsConstantSpeedOfTheToolOverTheSheet) {
  const SyntheticSheet sheet(*this->scene_.settings);
  const ToolPlace place{250.0, 512.0, 55.0, 20.0, 0.5, -0.3};
  const auto pose = pose_at<TypeParam>(*this->scene_.settings, sheet, place, kTube);
  const auto tool = find_tool_point<TypeParam>(this->scene_.model, pose);
  ASSERT_TRUE(tool.has_value());
  using M = Mm<TypeParam>;
  Motion<TypeParam> motion;
  motion.known = true;
  motion.interval_s = Unit<TypeParam>(0.02);
  motion.velocity_mm_s = {M(60), M(-30)};
  motion.approach_mm_s = M(20);
  for (const double turn : {0.0, 0.1}) {
    motion.turn_rad_s = {M(turn), M(0), M(-turn)};

    const auto after =
        predict<TypeParam>(this->scene_.model, pose, *tool, motion, Unit<TypeParam>(0.125));

    const auto there = find_tool_point<TypeParam>(this->scene_.model, after);
    ASSERT_TRUE(there.has_value());
    // Rising by 2.5 mm along a normal that leans by 0.6 degrees, and by up to 1.0 more with the
    // turn, takes the axis' point 2.5 mm times the lean aside: the prediction leaves that out.
    const double near = 2.5 * (0.0102 + 0.125 * 1.42 * turn) + bound<TypeParam>(1e-6, 1e-3, 1e-4);
    EXPECT_NEAR(number(there->local.x - tool->local.x), 7.5, near) << "turn " << turn;
    EXPECT_NEAR(number(there->local.y - tool->local.y), -3.75, near) << "turn " << turn;
    EXPECT_NEAR(number(there->height_mm - tool->height_mm), 2.5, near) << "turn " << turn;
    // 0.1 rad/s for 0.125 s about the camera's x less its z axis.
    const Eigen::Vector3d w(0.125 * turn, 0.0, -0.125 * turn);
    const Eigen::Vector3d normal = vector(pose.normal);
    EXPECT_LT((vector(after.normal) - normal - w.cross(normal)).norm(), 2e-4 * (turn > 0) + 1e-6);
  }
}

TYPED_TEST(MotionOf, PredictsNoMotionWhileItIsUnknown) {
  const SyntheticSheet sheet(*this->scene_.settings);
  const auto pose = pose_at<TypeParam>(*this->scene_.settings, sheet, kOverTube, kTube);
  const auto tool = find_tool_point<TypeParam>(this->scene_.model, pose);
  ASSERT_TRUE(tool.has_value());
  const auto after = predict<TypeParam>(this->scene_.model, pose, *tool, {}, Unit<TypeParam>(0.5));
  EXPECT_TRUE(after.origin == pose.origin);
  EXPECT_TRUE(after.normal == pose.normal);
}

TYPED_TEST(MotionOf, IsReadFromTwoPoses) {
  // 0.02 s apart: 3 mm along x, -1 mm along y, 0.5 mm nearer.
  const SyntheticSheet sheet(*this->scene_.settings);
  const ToolPlace first{250.0, 512.0, 55.0, 20.0, 0.0, 0.0};
  const ToolPlace second{253.0, 511.0, 54.5, 20.0, 0.0, 0.0};
  const auto before = pose_at<TypeParam>(*this->scene_.settings, sheet, first, kTube);
  const auto after = pose_at<TypeParam>(*this->scene_.settings, sheet, second, kTube);
  const auto tool_before = find_tool_point<TypeParam>(this->scene_.model, before);
  const auto tool_after = find_tool_point<TypeParam>(this->scene_.model, after);
  ASSERT_TRUE(tool_before && tool_after);

  const auto motion = motion_between<TypeParam>(before, *tool_before, after, *tool_after, {},
                                                Unit<TypeParam>(0.02));

  ASSERT_TRUE(motion.known);
  // Fixed point: a span in steps of 1e-6 s, 0.5e-6 / 0.02 of 150 mm/s are 0.004.
  const double near = bound<TypeParam>(1e-6, 1e-2, 5e-3);
  EXPECT_NEAR(number(motion.velocity_mm_s.x), 150.0, near);
  EXPECT_NEAR(number(motion.velocity_mm_s.y), -50.0, near);
  EXPECT_NEAR(number(motion.approach_mm_s), -25.0, near);
  EXPECT_NEAR(vector(motion.turn_rad_s).norm(), 0.0, bound<TypeParam>(1e-9, 2e-5, 1e-5));
}

TYPED_TEST(MotionOf, ReadsTheTurnsSenseAndNoMoreThanItsSize) {
  // A heading that grows by 0.2 degrees turns the sheet the other way before the camera: about the
  // normal by -0.00349 rad, -0.1745 rad/s; smoothing may halve it.
  const SyntheticSheet sheet(*this->scene_.settings);
  const auto before = pose_at<TypeParam>(*this->scene_.settings, sheet,
                                         {250.0, 512.0, 55.0, 20.0, 0.0, 0.0}, kTube);
  const auto after = pose_at<TypeParam>(*this->scene_.settings, sheet,
                                        {250.0, 512.0, 55.0, 20.2, 0.0, 0.0}, kTube);
  const auto tool_before = find_tool_point<TypeParam>(this->scene_.model, before);
  const auto tool_after = find_tool_point<TypeParam>(this->scene_.model, after);
  ASSERT_TRUE(tool_before && tool_after);

  auto motion = motion_between<TypeParam>(before, *tool_before, after, *tool_after, {},
                                          Unit<TypeParam>(0.02));
  const double first = vector(motion.turn_rad_s).dot(vector(after.normal));
  EXPECT_LE(first, -0.2 * 0.1745);
  EXPECT_GE(first, -1.01 * 0.1745);
  // Kept up, it comes near the whole of it.
  for (int i = 0; i < 10; ++i) {
    motion = motion_between<TypeParam>(before, *tool_before, after, *tool_after, motion,
                                       Unit<TypeParam>(0.02));
  }
  EXPECT_NEAR(vector(motion.turn_rad_s).dot(vector(after.normal)), -0.1745, 0.001);
}

TYPED_TEST(MotionOf, KeepsTheLastMotionWithinAMillisecond) {
  using M = Mm<TypeParam>;
  Motion<TypeParam> last;
  last.known = true;
  last.velocity_mm_s = {M(12), M(34)};
  const auto motion = motion_between<TypeParam>({}, {}, {}, {}, last, Unit<TypeParam>(0.0005));
  EXPECT_EQ(number(motion.velocity_mm_s.x), 12.0);
  EXPECT_EQ(number(motion.velocity_mm_s.y), 34.0);
}

TYPED_TEST(MotionOf, CarriesTheVelocitysDeviationOnOverTheSpan) {
  using S = TypeParam;
  const auto deviation = [](const Motion<S>& motion, double place, double span) {
    return number(velocity_deviation_mm<S>(motion, Mm<S>(place), Unit<S>(span)));
  };
  Motion<S> motion;
  motion.interval_s = Unit<S>(0.02);
  EXPECT_EQ(deviation(motion, 0.1, 0.02), 0.0) << "no motion is known";
  motion.known = true;
  // sqrt(2) * 0.1 mm * span / interval.
  EXPECT_NEAR(deviation(motion, 0.1, 0.02), 0.14142, 2e-4);
  EXPECT_NEAR(deviation(motion, 0.1, 0.06), 0.42426, 5e-4);
  // Bounded where the quotient would leave the format: sqrt(2) * 0.1 * 32.
  motion.interval_s = Unit<S>(0.001);
  EXPECT_NEAR(deviation(motion, 0.1, 0.9), 4.5255, 5e-3);
}

TYPED_TEST(MotionOf, RestsUnderThreeMillimetresASecond) {
  using S = TypeParam;
  Motion<S> motion;
  EXPECT_EQ(rest_of<S>(motion, Parity::kProgressive), Rest::kNone)
      << "an unknown motion is none at rest";
  motion.known = true;
  EXPECT_EQ(rest_of<S>(motion, Parity::kProgressive), Rest::kStill);
  motion.velocity_mm_s = {Mm<S>(2.0), Mm<S>(-2.2)};  // 2.97 mm/s
  EXPECT_EQ(rest_of<S>(motion, Parity::kProgressive), Rest::kStill);
  motion.velocity_mm_s = {Mm<S>(2.0), Mm<S>(-2.3)};  // 3.05 mm/s
  EXPECT_EQ(rest_of<S>(motion, Parity::kProgressive), Rest::kNone);
}

TYPED_TEST(MotionOf, RestsNearlyWhereAFewTubeEndsTellNoBetter) {
  using S = TypeParam;
  Motion<S> motion;
  motion.known = true;
  motion.approach_mm_s = Mm<S>(-2.9);
  EXPECT_EQ(rest_of<S>(motion, Parity::kProgressive), Rest::kStill);
  motion.approach_mm_s = Mm<S>(-5.0);
  EXPECT_EQ(rest_of<S>(motion, Parity::kProgressive), Rest::kNearly)
      << "the picture grows, or wavers";
  motion.approach_mm_s = Mm<S>(-10.1);
  EXPECT_EQ(rest_of<S>(motion, Parity::kProgressive), Rest::kNone);
  motion.approach_mm_s = {};
  motion.turn_rad_s.z = Mm<S>(-0.04);
  EXPECT_EQ(rest_of<S>(motion, Parity::kProgressive), Rest::kNearly) << "it turns, or wavers";
  motion.turn_rad_s.z = Mm<S>(-0.13);
  EXPECT_EQ(rest_of<S>(motion, Parity::kProgressive), Rest::kNone);
}

TYPED_TEST(MotionOf, OfTheFieldsOfAFrameRestsFromOneToTheLastOfItsParity) {
  using S = TypeParam;
  // Seven tube-ends lie 0.12 mm apart in the two fields, for ever.
  const SheetPose<S> pose{};
  const auto at = [](double x) {
    ToolPoint<S> tool{};
    tool.local.x = Mm<S>(x);
    return tool;
  };
  Motion<S> motion;
  for (const double from : {0.0, 0.12, 0.0}) {
    motion = motion_between<S>(pose, at(from), pose, at(0.12 - from), motion, Unit<S>(0.02));
  }
  EXPECT_EQ(rest_of<S>(motion, Parity::kEven), Rest::kStill);
  EXPECT_EQ(rest_of<S>(motion, Parity::kOdd), Rest::kStill);
  EXPECT_EQ(rest_of<S>(motion, Parity::kProgressive), Rest::kNone) << "whole frames: it shakes";
  motion = motion_between<S>(pose, at(0.12), pose, at(0.3), motion, Unit<S>(0.02));
  motion = motion_between<S>(pose, at(0.3), pose, at(0.4), motion, Unit<S>(0.02));
  EXPECT_EQ(rest_of<S>(motion, Parity::kEven), Rest::kNone);
}

TYPED_TEST(MotionOf, TravelsFromThirtyMillimetresASecondOn) {
  using S = TypeParam;
  Motion<S> motion;
  motion.velocity_mm_s = {Mm<S>(300.0), Mm<S>(0.0)};
  EXPECT_FALSE(travels<S>(motion)) << "an unknown motion is none";
  motion.known = true;
  EXPECT_TRUE(travels<S>(motion));
  motion.velocity_mm_s = {Mm<S>(20.0), Mm<S>(-22.0)};  // 29.7 mm/s
  EXPECT_FALSE(travels<S>(motion));
}

}  // namespace
}  // namespace tubesight::core::tracking
