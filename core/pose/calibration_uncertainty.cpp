#include "core/pose/calibration_uncertainty.h"

#include <Eigen/Geometry>

#include "core/base/trigonometry.h"
#include "core/camera/camera_setup.h"
#include "core/math/covariance.h"
#include "core/math/rotation.h"

namespace tubesight::core::pose {
namespace {

using SheetTool = Transform<frames::Sheet, frames::Tool>;

math::Matrix6d carried(const math::Matrix6d& J, const math::Matrix6d& covariance) {
  const math::Matrix6d half = J.lazyProduct(covariance);
  return half.lazyProduct(J.transpose());
}

// The pose that a changed camera gives for the same rims.
Result<SheetTool> pose_with(const PoseModel& model, const CameraSettings& camera,
                            const picture::RimList& rims, const PoseEstimate& estimate,
                            const RimBundleOptions& options, PoseWorkspace& workspace) {
  const auto camera_model = camera::make_camera_model<double>(camera);
  if (!camera_model) {
    return Unexpected(camera_model.error());
  }
  PoseModel changed = model;
  changed.camera = *camera_model;
  to_plane_points(changed.camera, rims, workspace.points);
  const RimFit fit =
      fit_rims(changed, rims, estimate.T_sheet_tool, options, workspace.points, workspace.bundle);
  if (!fit.solved) {
    return Unexpected(Error::kIllConditioned);
  }
  return fit.T_sheet_tool;
}

}  // namespace

void change_parameter(CameraSettings& camera, CameraParameter parameter, double by) {
  switch (parameter) {
    case CameraParameter::kFocalLength: camera.focal_length_mm += by; break;
    case CameraParameter::kHorizontalScale: camera.horizontal_scale += by; break;
    case CameraParameter::kCenterU: camera.center_px[0] += by; break;
    case CameraParameter::kCenterV: camera.center_px[1] += by; break;
    case CameraParameter::kDistortion: camera.distortion_per_mm2 += by; break;
    case CameraParameter::kDistortion2: camera.distortion2_per_mm4 += by; break;
  }
}

Result<math::Matrix6d> camera_sensitivity(const PoseModel& model, const picture::RimList& rims,
                                          const PoseEstimate& estimate,
                                          const std::array<double, 6>& steps,
                                          const RimBundleOptions& options,
                                          PoseWorkspace& workspace) {
  math::Matrix6d J = math::Matrix6d::Zero();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i] == 0.0) {
      continue;
    }
    const auto parameter = static_cast<CameraParameter>(i);
    CameraSettings up = model.camera_settings;
    CameraSettings down = model.camera_settings;
    change_parameter(up, parameter, 0.5 * steps[i]);
    change_parameter(down, parameter, -0.5 * steps[i]);
    const auto above = pose_with(model, up, rims, estimate, options, workspace);
    const auto below = pose_with(model, down, rims, estimate, options, workspace);
    if (!above || !below) {
      return Unexpected(above ? below.error() : above.error());
    }
    const auto column = static_cast<Eigen::Index>(i);
    J.col(column).head<3>() = (above->translation_mm() - below->translation_mm()) / steps[i];
    J.col(column).tail<3>() =
        math::log_rotation(above->rotation() * below->rotation().transpose()) / steps[i];
  }
  return J;
}

math::Matrix6d tool_sensitivity(const PoseModel& model, const PoseEstimate& estimate) {
  const Eigen::Matrix3d R_sheet_camera = estimate.T_camera_sheet.rotation().transpose();
  const std::array<double, 3> angles = math::angles_of(model.T_camera_tool.rotation());
  const Eigen::Matrix3d Rz = math::exp_rotation(Eigen::Vector3d(0.0, 0.0, angles[0]));
  const Eigen::Matrix3d Ry = math::exp_rotation(Eigen::Vector3d(0.0, angles[1], 0.0));
  Eigen::Matrix3d turns;  // rotation vectors in the camera frame
  turns << Eigen::Vector3d::UnitZ(), Rz.col(1), Rz * Ry.col(0);
  math::Matrix6d J = math::Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = R_sheet_camera;
  J.bottomRightCorner<3, 3>() = radians(1.0) * (R_sheet_camera * turns);
  return J;
}

Result<math::Matrix6d> calibration_covariance(const PoseModel& model, const picture::RimList& rims,
                                              const PoseEstimate& estimate,
                                              const CalibrationUncertainty& uncertainty,
                                              const RimBundleOptions& options,
                                              PoseWorkspace& workspace) {
  const auto by_camera =
      camera_sensitivity(model, rims, estimate, uncertainty.camera_sigma, options, workspace);
  if (!by_camera) {
    return Unexpected(by_camera.error());
  }
  const math::Matrix6d camera = carried(
      *by_camera, math::covariance_of(uncertainty.camera_sigma, uncertainty.camera_correlation));
  const math::Matrix6d by_tool = tool_sensitivity(model, estimate);
  const math::Matrix6d tool =
      carried(by_tool, math::covariance_of(uncertainty.tool_sigma, uncertainty.tool_correlation));
  // With e_f the EFL's error and e_v the tool's: J_f E[e_f e_v^T] J_v^T, and its transpose.
  math::Vector6d together;
  for (std::size_t i = 0; i < uncertainty.tool_sigma.size(); ++i) {
    together(static_cast<Eigen::Index>(i)) = uncertainty.focal_length_correlation[i] *
                                             uncertainty.camera_sigma[0] *
                                             uncertainty.tool_sigma[i];
  }
  const math::Vector6d carried_together = by_tool.lazyProduct(together);
  const math::Matrix6d cross = by_camera->col(0).lazyProduct(carried_together.transpose());
  return math::Matrix6d(camera + tool + cross + cross.transpose());
}

}  // namespace tubesight::core::pose
