#include <cmath>

#include <gtest/gtest.h>

#include "core/pose/calibration_uncertainty.h"
#include "core/pose/tool_answer.h"
#include "tests/core/pose/pose_test_support.h"

namespace tubesight::core::pose {
namespace {

using SheetTool = Transform<frames::Sheet, frames::Tool>;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

// Square 25.4 mm, tube (18, 30) at (762, 457.2); tip 40 mm below, axis leaning 1 degree towards +x.
PoseModel square_model() { return PoseScene().model; }
SheetTool leaning_tool() {
  return {rotation_from_degrees({0.0, 1.0, 0.0}), Eigen::Vector3d(761.0, 458.0, -40.0)};
}

TEST(ToolPose, IsTheConcatenationOfTheSource) {
  const Transform<frames::Camera, frames::Sheet> T_camera_sheet(
      rotation_from_degrees({20.0, 5.0, 40.0}), Eigen::Vector3d(1.0, 2.0, 150.0));
  const Transform<frames::Camera, frames::Tool> T_camera_tool(
      rotation_from_degrees({0.0, -1.0, 48.0}), Eigen::Vector3d(-3.0, 31.0, 112.0));

  const SheetTool T = tool_pose(T_camera_sheet, T_camera_tool);

  // The tip through the camera lands where the tool's origin is [Fallon eq. 5.40].
  EXPECT_LT((T_camera_sheet * T.translation_mm() - T_camera_tool.translation_mm()).norm(), 1e-12);
  EXPECT_LT(
      (T.rotation() - T_camera_sheet.rotation().transpose() * T_camera_tool.rotation()).norm(),
      1e-14);
}

TEST(ToolCovariance, CarriesSmallErrorsOver) {
  const Transform<frames::Camera, frames::Sheet> T_camera_sheet(
      rotation_from_degrees({20.0, 5.0, 40.0}), Eigen::Vector3d(1.0, 2.0, 150.0));
  const Transform<frames::Camera, frames::Tool> T_camera_tool(
      rotation_from_degrees({0.0, -1.0, 48.0}), Eigen::Vector3d(-3.0, 31.0, 112.0));
  const SheetTool before = tool_pose(T_camera_sheet, T_camera_tool);
  math::Matrix6d J;
  for (int i = 0; i < 6; ++i) {
    math::Vector6d step = math::Vector6d::Zero();
    step(i) = 1e-6;
    const Transform<frames::Camera, frames::Sheet> moved(
        math::exp_rotation(step.tail<3>()) * T_camera_sheet.rotation(),
        T_camera_sheet.translation_mm() + step.head<3>());
    J.col(i) = pose_error(before, tool_pose(moved, T_camera_tool)) / 1e-6;
  }
  math::Matrix6d covariance = math::Matrix6d::Identity();
  covariance(0, 4) = covariance(4, 0) = 0.3;

  const math::Matrix6d carried = tool_covariance(covariance, T_camera_sheet, T_camera_tool);

  EXPECT_LT((carried - J * covariance * J.transpose()).norm(), 1e-3 * carried.norm());
}

TEST(OffsetFromNearest, FollowsTheAxisAndNotTheTip) {
  const TubeOffset offset = offset_from_nearest(square_model(), leaning_tool());

  EXPECT_EQ(offset.address.row, 18);
  EXPECT_EQ(offset.address.column, 30);
  EXPECT_NEAR(offset.axis_mm.x(), 761.0 + 40.0 * std::tan(kDegree), 1e-9);
  EXPECT_NEAR(offset.offset_mm.x(), -1.0 + 40.0 * std::tan(kDegree), 1e-9);
  EXPECT_NEAR(offset.offset_mm.y(), 0.8, 1e-9);
  EXPECT_NEAR(offset.tip_mm.x(), -1.0, 1e-9);
  EXPECT_NEAR(offset.tip_mm.z(), -40.0, 1e-12);
  EXPECT_NEAR(offset.tilt_rad, kDegree, 1e-12);
}

TEST(ToolSensitivity, IsThatOfTheToolsNumbers) {
  PoseScene scene;
  PoseEstimate estimate;
  estimate.T_camera_sheet = scene.model.T_camera_tool * leaning_tool().inverse();
  estimate.T_sheet_tool = leaning_tool();

  const math::Matrix6d J = tool_sensitivity(scene.model, estimate);

  const ToolSettings& tool = scene.settings().tool;
  for (std::size_t i = 0; i < 6; ++i) {
    ToolSettings changed = tool;
    (i < 3 ? changed.position_mm[i] : changed.rotation_deg[i - 3]) += 1e-6;
    const SheetTool moved = tool_pose(estimate.T_camera_sheet, tool_transform(changed));
    const math::Vector6d difference = pose_error(leaning_tool(), moved) / 1e-6;
    EXPECT_LT((difference - J.col(static_cast<Eigen::Index>(i))).norm(), 1e-6) << i;
  }
}

TEST(CalibrationCovariance, MatchesTheErrorThatAWrongCameraMakes) {
  PoseScene scene;
  const tests::ToolPlace place{762.4, 457.0, 40.0, 33.0, 0.4, -0.7};
  scene.see(place, 25, {});
  const PoseOutcome right = scene.estimate();
  ASSERT_TRUE(right.has_value());
  CalibrationUncertainty uncertainty;
  uncertainty.camera_sigma = {0.005, 0.0, 0.0, 0.0, 0.0, 0.0};

  const auto share = calibration_covariance(scene.model, *scene.rims, right.estimate, uncertainty,
                                            {}, *scene.workspace);

  ASSERT_TRUE(share.has_value());
  CameraSettings camera = scene.settings().camera;
  camera.focal_length_mm += 0.005;
  const auto wrong = make_pose_model(camera, scene.settings().tool, scene.settings().tubesheet);
  ASSERT_TRUE(wrong.has_value());
  const PoseOutcome off = estimate_pose(*wrong, *scene.rims, {}, *scene.workspace);
  ASSERT_TRUE(off.has_value());
  const math::Vector6d error = pose_error(right.estimate.T_sheet_tool, off.estimate.T_sheet_tool);
  EXPECT_GT(error.head<3>().norm(), 0.05);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::sqrt((*share)(i, i)), std::abs(error(i)), 0.02 * error.head<3>().norm()) << i;
  }
}

TEST(CalibrationCovariance, LetsAnEflFoundAtDockingCancelInTheTool) {
  PoseScene scene;
  const tests::ToolPlace place{762.4, 457.0, 0.0, 33.0, 0.0, 0.0};
  scene.see(place, 25, {});
  const PoseOutcome right = scene.estimate();
  ASSERT_TRUE(right.has_value());
  CalibrationUncertainty uncertainty;
  uncertainty.camera_sigma = {0.005, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto by_camera = calibration_covariance(scene.model, *scene.rims, right.estimate,
                                                uncertainty, {}, *scene.workspace);
  ASSERT_TRUE(by_camera.has_value());
  // A tool whose place is wrong by what the EFL makes wrong: docked, the tip is where it is.
  const math::Matrix6d J = tool_sensitivity(scene.model, right.estimate);
  const auto slope = camera_sensitivity(scene.model, *scene.rims, right.estimate,
                                        uncertainty.camera_sigma, {}, *scene.workspace);
  ASSERT_TRUE(slope.has_value());
  const math::Vector6d tool = -0.005 * J.inverse() * slope->col(0);
  for (std::size_t i = 0; i < 6; ++i) {
    const double value = tool(static_cast<Eigen::Index>(i));
    uncertainty.tool_sigma[i] = std::abs(value);
    uncertainty.focal_length_correlation[i] = value < 0.0 ? -1.0 : 1.0;
    for (std::size_t k = 0; k < 6; ++k) {
      uncertainty.tool_correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          value * tool(static_cast<Eigen::Index>(k)) < 0.0 ? -1.0 : 1.0;
    }
  }

  const auto both = calibration_covariance(scene.model, *scene.rims, right.estimate, uncertainty,
                                           {}, *scene.workspace);

  ASSERT_TRUE(both.has_value());
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs((*both)(i, i)), 1e-6 * (*by_camera)(2, 2)) << i;
  }
}

}  // namespace
}  // namespace tubesight::core::pose
