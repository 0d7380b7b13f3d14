#include "core/kinematics/serial_arm.h"

#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/trigonometry.h"
#include "core/kinematics/cobra_arm.h"
#include "core/kinematics/inverse_kinematics.h"
#include "tests/core/kinematics/arms.h"

namespace tubesight::core::kinematics {
namespace {

TEST(SerialArm, APlanarArmStandsWhereTrigonometrySays) {
  const SerialArm arm = planar_arm();
  const struct {
    double q1_deg, q2_deg, x_mm, y_mm, heading_deg;
  } rows[] = {{0, 0, 1500, 0, 0},
              {90, 0, 0, 1500, 90},
              {90, -90, 500, 1000, 0},
              {30, 60, 866.0254037844386, 1000, 90},
              {180, 90, -1000, -500, 270}};
  for (const auto& row : rows) {
    const auto T = arm.forward({radians(row.q1_deg), radians(row.q2_deg)});

    EXPECT_NEAR(T.translation_mm().x(), row.x_mm, 1e-9) << row.q1_deg << ' ' << row.q2_deg;
    EXPECT_NEAR(T.translation_mm().y(), row.y_mm, 1e-9) << row.q1_deg << ' ' << row.q2_deg;
    EXPECT_NEAR(T.translation_mm().z(), 0.0, 1e-9);
    const Eigen::Matrix3d expected = rotation_from_degrees({row.heading_deg, 0.0, 0.0});
    EXPECT_LT((T.rotation() - expected).norm(), 1e-12) << row.q1_deg << ' ' << row.q2_deg;
  }
}

TEST(SerialArm, EachLinkParameterDoesWhatItsNameSays) {
  // d lifts along the joint's axis; the twist of 90 degrees lays the next axis along -y; the second
  // joint then lifts its link by 30 degrees; the offset adds to the reading.
  const Link links[] = {{100.0, 250.0, radians(90.0), 0.0, -3.0, 3.0},
                        {400.0, 50.0, 0.0, radians(20.0), -3.0, 3.0}};
  const auto arm =
      SerialArm::make(links, {Eigen::Matrix3d::Identity(), Eigen::Vector3d(10.0, 0.0, 0.0)});
  ASSERT_TRUE(arm);

  const auto T = arm->forward({0.0, radians(10.0)});

  EXPECT_NEAR(T.translation_mm().x(), 100.0 + 410.0 * 0.8660254037844386, 1e-9);
  EXPECT_NEAR(T.translation_mm().y(), -50.0, 1e-9);
  EXPECT_NEAR(T.translation_mm().z(), 250.0 + 410.0 * 0.5, 1e-9);
}

TEST(SerialArm, TheCobraIsReadyWithItsToolSquare) {
  // Shoulder 250 up, upper arm at 75 degrees, forearm at -30, tool 330 straight up.
  const auto T = cobra_arm().forward(cobra_ready());

  EXPECT_NEAR(T.translation_mm().x(), 1000.0 * 0.25881904510252074 + 940.0 * 0.8660254037844386,
              1e-9);
  EXPECT_NEAR(T.translation_mm().y(), 0.0, 1e-9);
  EXPECT_NEAR(T.translation_mm().z(), 250.0 + 1000.0 * 0.9659258262890683 - 470.0 + 330.0, 1e-9);
  EXPECT_LT((T.rotation() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(SerialArm, TheCobraReachesAsFarAsTheSourceSays) {
  // Arm straight out, wrist bent up: 1.94 m [Fallon sec. 1.1.2].
  const auto T = cobra_arm().forward({radians(90.0), 0.0, 0.0, radians(90.0), 0.0, 0.0});

  EXPECT_NEAR(T.translation_mm().x(), 0.0, 1e-9);
  EXPECT_NEAR(T.translation_mm().y(), 1940.0, 1e-9);
  EXPECT_NEAR(T.rotation()(2, 2), 1.0, 1e-12) << "the tool points up";
  EXPECT_NEAR(T.rotation()(1, 0), 1.0, 1e-12) << "the heading is the sum of joints 1 and 6";
}

TEST(SerialArm, TheWristLeansTheTool) {
  JointVector angles = cobra_ready();
  angles[3] += radians(2.0);
  // Joint 4 lifts: the tool's axis falls back towards the base.
  EXPECT_NEAR(cobra_arm().forward(angles).rotation()(0, 2), -0.03489949670250097, 1e-12);
  angles = cobra_ready();
  angles[4] = radians(1.0);
  // Joint 5 turns about the way out, +x: up tips to -y.
  EXPECT_NEAR(cobra_arm().forward(angles).rotation()(1, 2), -0.01745240643728351, 1e-12);
}

TEST(SerialArm, TheJacobianIsTheDerivative) {
  std::mt19937 random(2);
  for (const SerialArm& arm : {cobra_arm(), planar_arm(), eight_joints()}) {
    for (int i = 0; i < 50; ++i) {
      const JointVector q = anywhere(arm, random);
      const ArmJacobian J = arm.jacobian(q);
      for (std::int32_t joint = 0; joint < kMaxJoints; ++joint) {
        if (joint >= arm.joints()) {
          EXPECT_EQ(J.col(joint).norm(), 0.0);
          continue;
        }
        constexpr double kStep = 1e-5;
        JointVector less = q;
        JointVector more = q;
        less[static_cast<std::size_t>(joint)] -= kStep;
        more[static_cast<std::size_t>(joint)] += kStep;
        const auto a = arm.forward(less);
        const auto b = arm.forward(more);
        const Eigen::Vector3d way = (b.translation_mm() - a.translation_mm()) / (2.0 * kStep);
        const Eigen::Vector3d turn = turn_between(a.rotation(), b.rotation()) / (2.0 * kStep);
        EXPECT_LT((J.col(joint).head<3>() - way).norm(), 1e-5) << "seed 2, " << i << ' ' << joint;
        EXPECT_LT((J.col(joint).tail<3>() - turn).norm(), 1e-8) << "seed 2, " << i << ' ' << joint;
      }
    }
  }
}

TEST(SerialArm, KnowsItsLimits) {
  const SerialArm arm = cobra_arm();
  JointVector angles = cobra_ready();
  EXPECT_TRUE(arm.within_limits(angles));
  angles[4] = radians(60.1);
  angles[7] = 3.0;

  EXPECT_FALSE(arm.within_limits(angles));
  const JointVector limited = arm.limited(angles);
  EXPECT_DOUBLE_EQ(limited[4], radians(60.0));
  EXPECT_EQ(limited[7], 0.0) << "there is no eighth joint";
  EXPECT_EQ(limited[3], angles[3]);
  EXPECT_TRUE(arm.within_limits(limited));
}

TEST(SerialArm, RefusesWhatIsNoArm) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Transform<LinkFrame, frames::Tool> tool;
  const auto refused = [&](const std::vector<Link>& links) {
    const auto arm = SerialArm::make(links, tool);
    return !arm && arm.error() == Error::kInvalidArgument;
  };

  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused(std::vector<Link>(9)));
  EXPECT_TRUE(refused({{nan, 0.0, 0.0, 0.0, -1.0, 1.0}}));
  EXPECT_TRUE(refused({{0.0, 0.0, nan, 0.0, -1.0, 1.0}}));
  EXPECT_TRUE(refused({{0.0, 0.0, 0.0, 0.0, 1.0, -1.0}}));
  EXPECT_TRUE(refused({{0.0, 0.0, 0.0, 0.0, nan, 1.0}}));
  EXPECT_FALSE(refused(std::vector<Link>(8)));
}

}  // namespace
}  // namespace tubesight::core::kinematics
