#include "core/verification/position_correction.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/pose/tool_answer.h"
#include "tests/core/pose/pose_test_support.h"

namespace tubesight::core::verification {
namespace {

using math::Matrix6d;
using pose::offset_from;
using pose::PoseModel;
using pose::TubeOffset;
using SheetTool = Transform<frames::Sheet, frames::Tool>;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

// Square 25.4 mm, tube (18, 30) at (762, 457.2); tip 40 mm below, axis leaning 1 degree towards +x.
PoseModel square_model() { return pose::PoseScene().model; }
SheetTool leaning_tool() {
  return {rotation_from_degrees({0.0, 1.0, 0.0}), Eigen::Vector3d(761.0, 458.0, -40.0)};
}

TEST(CorrectPosition, BringsTheTipUnderTheTube) {
  const PositionCorrection correction =
      correct_position(square_model(), leaning_tool(), Matrix6d::Zero(), {.tube = {18, 31}});

  const SheetTool after = leaning_tool() * correction.move;
  EXPECT_LT((after.translation_mm() - Eigen::Vector3d(787.4, 457.2, -40.0)).norm(), 1e-9);
  EXPECT_LT((after.rotation() - leaning_tool().rotation()).norm(), 1e-12);
  EXPECT_NEAR(correction.distance_mm, std::hypot(26.4, 0.8), 1e-9);
  EXPECT_NEAR(correction.turn_rad, 0.0, 1e-9);
  EXPECT_FALSE(correction.met_now);
  EXPECT_TRUE(correction.met_after);
}

TEST(CorrectPosition, PutsTheLeaningAxisThroughTheTube) {
  const PositionCorrection correction =
      correct_position(square_model(), leaning_tool(), Matrix6d::Zero(),
                       {.tube = {18, 30}, .goal = CorrectionGoal::kAxisThrough});

  const TubeOffset after = offset_from(square_model(), leaning_tool() * correction.move, {18, 30});
  EXPECT_NEAR(after.distance_mm, 0.0, 1e-9);
  EXPECT_NEAR(after.tip_mm.z(), -40.0, 1e-9);
  EXPECT_NEAR(after.tilt_rad, kDegree, 1e-9);
}

TEST(CorrectPosition, SquaresTheToolUpWithoutTurningIt) {
  const PositionCorrection correction =
      correct_position(square_model(), leaning_tool(), Matrix6d::Zero(),
                       {.tube = {18, 30}, .goal = CorrectionGoal::kSquaredUp});

  const SheetTool after = leaning_tool() * correction.move;
  EXPECT_LT((after.rotation() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  EXPECT_LT((after.translation_mm() - Eigen::Vector3d(762.0, 457.2, -40.0)).norm(), 1e-9);
  EXPECT_NEAR(correction.turn_rad, kDegree, 1e-9);
}

TEST(CorrectPosition, CountsUncertaintyAgainstTheLimit) {
  // 0.4 mm off with 0.1 mm of deviation: within a probe's limit, not surely within a plug tool's.
  const SheetTool tool(Eigen::Matrix3d::Identity(), {762.4, 457.2, -40.0});
  Matrix6d covariance = Matrix6d::Zero();
  covariance(0, 0) = covariance(1, 1) = 0.01;

  const auto probe = correct_position(square_model(), tool, covariance, {.tube = {18, 30}});
  const auto plug = correct_position(square_model(), tool, covariance,
                                     {.tube = {18, 30}, .limit_mm = kPlugToolLimit_mm});
  const auto shaky =
      correct_position(square_model(), tool, covariance,
                       {.tube = {18, 30}, .limit_mm = kPlugToolLimit_mm, .move_sigma_mm = 0.15});

  EXPECT_TRUE(probe.met_now);
  EXPECT_FALSE(plug.met_now);
  EXPECT_NEAR(plug.offset_bound_mm, 0.4 + 0.3035, 1e-6);
  EXPECT_TRUE(plug.met_after);
  EXPECT_NEAR(plug.left_mm, 0.3035, 1e-6);
  EXPECT_FALSE(shaky.met_after);  // 3.035 sqrt(0.01 + 0.0225) = 0.547
}

TEST(CorrectPosition, CarriesTheHeadingsErrorOverTheWay) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance(5, 5) = 1e-4;  // 10 mrad of heading
  const SheetTool tool(Eigen::Matrix3d::Identity(), {762.0, 457.2, -40.0});

  const auto correction = correct_position(square_model(), tool, covariance, {.tube = {18, 34}});

  // 101.6 mm along x: 1.016 mm of deviation in y.
  EXPECT_NEAR(std::sqrt(correction.left_covariance(1, 1)), 1.016, 1e-9);
  EXPECT_NEAR(correction.left_covariance(0, 0), 0.0, 1e-12);
}

TEST(AxisCovariance, FollowsTheLeanToTheSheet) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance(4, 4) = 1e-6;  // 1 mrad about y leans towards x
  const SheetTool tool(Eigen::Matrix3d::Identity(), {762.0, 457.2, -40.0});

  const Eigen::Matrix2d at_sheet = axis_covariance(tool, covariance);

  EXPECT_NEAR(std::sqrt(at_sheet(0, 0)), 0.040, 1e-12);
  EXPECT_NEAR(at_sheet(1, 1), 0.0, 1e-15);
}

}  // namespace
}  // namespace tubesight::core::verification
