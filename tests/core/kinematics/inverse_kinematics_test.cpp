#include "core/kinematics/inverse_kinematics.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "core/base/trigonometry.h"
#include "core/kinematics/cobra_arm.h"
#include "tests/core/kinematics/arms.h"

namespace tubesight::core::kinematics {
namespace {

using Pose = Transform<frames::Base, frames::Tool>;

void expect_reached(const SerialArm& arm, const Pose& goal, const JointVector& angles_rad) {
  const Pose there = arm.forward(angles_rad);
  EXPECT_LT((there.translation_mm() - goal.translation_mm()).norm(), 2e-6);
  EXPECT_LT((there.rotation() - goal.rotation()).norm(), 1e-8);
  EXPECT_TRUE(arm.within_limits(angles_rad));
}

TEST(InverseKinematics, FindsThePlanarArmsElbowByTheStart) {
  // 1000 and 500 mm at a right angle: 1118 mm away; the elbow at +90 or -90 degrees.
  const SerialArm arm = planar_arm();
  InverseOptions options;
  options.position_only = true;
  const Pose goal(Eigen::Matrix3d::Identity(), Eigen::Vector3d(1000.0, 500.0, 0.0));

  const auto left = inverse(arm, goal, {-0.2, 1.0}, options);
  const auto right = inverse(arm, goal, {0.8, -1.0}, options);

  ASSERT_TRUE(left);
  EXPECT_NEAR(left->angles_rad[0], 0.0, 1e-8);
  EXPECT_NEAR(left->angles_rad[1], radians(90.0), 1e-8);
  ASSERT_TRUE(right);
  EXPECT_NEAR(right->angles_rad[0], 2.0 * 0.4636476090008061, 1e-8) << "2 atan(1/2)";
  EXPECT_NEAR(right->angles_rad[1], radians(-90.0), 1e-8);
  EXPECT_EQ(left->restarts, 0);
}

TEST(InverseKinematics, ReachesTheWholeWorkspaceOfTheCobraUnderASheet) {
  // A sheet a metre above the base, tool within two degrees of square, any heading.
  const SerialArm arm = cobra_arm();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  int restarted = 0;
  for (int i = 0; i < 2000; ++i) {
    const double reach = 1050.0 + 780.0 * share(random);
    const double around = radians(160.0 * share(random));
    const Pose goal(
        rotation_from_degrees({170.0 * share(random), 2.0 * share(random), 2.0 * share(random)}),
        Eigen::Vector3d(reach * std::cos(around), reach * std::sin(around),
                        955.0 + 45.0 * share(random)));

    const auto solution = inverse(arm, goal, cobra_ready());

    ASSERT_TRUE(solution) << "seed 3, number " << i;
    expect_reached(arm, goal, solution->angles_rad);
    EXPECT_LE(solution->miss_mm, 1e-6);
    restarted += solution->restarts > 0 ? 1 : 0;
  }
  EXPECT_LT(restarted, 400);
}

TEST(InverseKinematics, ReachesWhereverJointsCanPutTheTool) {
  std::mt19937 random(4);
  for (const SerialArm& arm : {cobra_arm(), eight_joints()}) {
    for (int i = 0; i < 200; ++i) {
      const Pose goal = arm.forward(anywhere(arm, random));

      const auto solution = inverse(arm, goal, {});

      ASSERT_TRUE(solution) << "seed 4, number " << i << " of " << arm.joints() << " joints";
      expect_reached(arm, goal, solution->angles_rad);
    }
  }
}

TEST(InverseKinematics, FollowsAWayInSmallStepsWithoutChangingTheElbow) {
  const SerialArm arm = cobra_arm();
  JointVector angles = cobra_ready();
  InverseOptions options;
  options.restarts = 0;
  const Pose ready = arm.forward(angles);
  for (int i = 1; i <= 150; ++i) {
    const Pose goal(ready.rotation(),
                    ready.translation_mm() + Eigen::Vector3d(2.0 * i, 4.0 * i, -0.3 * i));

    const auto solution = inverse(arm, goal, angles, options);

    ASSERT_TRUE(solution) << i;
    expect_reached(arm, goal, solution->angles_rad);
    EXPECT_LE(solution->iterations, 6) << i;
    EXPECT_LT(solution->angles_rad[2], 0.0) << "elbow up";
    for (std::size_t joint = 0; joint < angles.size(); ++joint) {
      EXPECT_NEAR(solution->angles_rad[joint], angles[joint], 0.02) << i << ' ' << joint;
    }
    angles = solution->angles_rad;
  }
}

TEST(InverseKinematics, SaysWhatIsOutOfReach) {
  const SerialArm arm = cobra_arm();
  const Eigen::Matrix3d square = Eigen::Matrix3d::Identity();
  const auto error_at = [&](const Eigen::Matrix3d& rotation, double x_mm, double z_mm) {
    const auto solution = inverse(arm, {rotation, Eigen::Vector3d(x_mm, 0.0, z_mm)}, cobra_ready());
    return solution ? Error::kTimeout : solution.error();
  };

  EXPECT_EQ(error_at(square, 1941.0, 580.0), Error::kOutOfRange) << "1 mm beyond full extension";
  EXPECT_EQ(error_at(square, 1939.9, 580.0), Error::kTimeout) << "just within";
  EXPECT_EQ(error_at(square, 20.0, 580.0), Error::kOutOfRange) << "the elbow's limit";
  // On its side across the arm: joint 5 would have to turn by 90 degrees.
  EXPECT_EQ(error_at(rotation_from_degrees({0.0, 0.0, 90.0}), 1900.0, 330.0), Error::kOutOfRange);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_at(square, nan, 580.0), Error::kInvalidArgument);
}

TEST(InverseKinematics, HoldsJointsAtTheirLimits) {
  // The first joint may turn to 20 degrees only: the elbow does the rest, on one side alone.
  const Link links[] = {{1000.0, 0.0, 0.0, 0.0, radians(-20.0), radians(20.0)},
                        {500.0, 0.0, 0.0, 0.0, -3.0, 3.0}};
  const auto arm = SerialArm::make(links, {});
  ASSERT_TRUE(arm);
  InverseOptions options;
  options.position_only = true;
  const Pose goal(Eigen::Matrix3d::Identity(), Eigen::Vector3d(1000.0, 500.0, 0.0));

  const auto solution = inverse(*arm, goal, {radians(20.0), -0.5}, options);

  ASSERT_TRUE(solution);
  EXPECT_TRUE(arm->within_limits(solution->angles_rad));
  EXPECT_NEAR(solution->angles_rad[0], 0.0, 1e-8);
}

TEST(TurnBetween, IsTheAngleAboutTheAxisFromAnyRotationToAnyOther) {
  const Eigen::Matrix3d from = rotation_from_degrees({20.0, -30.0, 40.0});
  for (const double angle_deg : {0.0, 1e-5, 1.0, 90.0, 179.0, -1.0, -120.0, -179.0}) {
    const double chord = 2.0 * std::sin(0.5 * radians(angle_deg));
    const auto turned = [&](const std::array<double, 3>& angles_deg) {
      return turn_between(from, rotation_from_degrees(angles_deg) * from);
    };

    EXPECT_LT((turned({angle_deg, 0.0, 0.0}) - Eigen::Vector3d(0.0, 0.0, chord)).norm(), 1e-14);
    EXPECT_LT((turned({0.0, angle_deg, 0.0}) - Eigen::Vector3d(0.0, chord, 0.0)).norm(), 1e-14);
    EXPECT_LT((turned({0.0, 0.0, angle_deg}) - Eigen::Vector3d(chord, 0.0, 0.0)).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace tubesight::core::kinematics
