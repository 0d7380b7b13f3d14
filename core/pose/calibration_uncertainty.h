#pragma once

#include <array>
#include <cstdint>

#include "core/base/result.h"
#include "core/math/small_matrix.h"
#include "core/pose/pose_estimate.h"

namespace tubesight::core::pose {

/// The camera's parameters in the order of CalibrationUncertainty.
enum class CameraParameter : std::uint8_t {
  kFocalLength,      ///< mm
  kHorizontalScale,  ///< h_sx
  kCenterU,          ///< px
  kCenterV,          ///< px
  kDistortion,       ///< k, per mm^2
  kDistortion2,      ///< k2, per mm^4
};
inline constexpr std::int32_t kCameraParameters = 6;

/// What the calibrations leave uncertain: tables `[camera_quality]` and `[tool_quality]`.
struct CalibrationUncertainty {
  /// Standard deviations in the order of CameraParameter; zero: exact, or held fixed.
  std::array<double, 6> camera_sigma{};
  math::Matrix6d camera_correlation = math::Matrix6d::Identity();
  /// Of T_camera_tool: x, y, z in mm, alpha, beta, gamma in degrees, as in `[tool]`.
  std::array<double, 6> tool_sigma{};
  math::Matrix6d tool_correlation = math::Matrix6d::Identity();
  /// Of the six with the camera's EFL, where one docking told both.
  std::array<double, 6> focal_length_correlation{};
};

/// Adds `by` to one parameter of the camera.
void change_parameter(CameraSettings& camera, CameraParameter parameter, double by);

/// Derivatives of T_sheet_tool, (tau, theta), by the camera's parameters: central differences of
/// the whole fit, half a `step` to either side. A step of zero leaves its column zero.
///
/// Twelve fits. kOutOfRange: a changed camera can't be made; kIllConditioned: a fit fails.
[[nodiscard]] Result<math::Matrix6d> camera_sensitivity(
    const PoseModel& model, const picture::RimList& rims, const PoseEstimate& estimate,
    const std::array<double, 6>& steps, const RimBundleOptions& options, PoseWorkspace& workspace);

/// Derivatives of T_sheet_tool, (tau, theta), by x, y, z (mm) and alpha, beta, gamma (degrees) of
/// T_camera_tool = Rz(alpha) Ry(beta) Rx(gamma), the sheet's pose in the camera frame unchanged.
[[nodiscard]] math::Matrix6d tool_sensitivity(const PoseModel& model, const PoseEstimate& estimate);

/// The calibrations' share of the covariance of T_sheet_tool, to be added to the picture's: what
/// `--total` tells. Errors as of camera_sensitivity().
///
/// The two calibrations count as independent of each other, but for the EFL where docking told it
/// with the tool: there one makes up for much of the other. A tool calibration made with the same
/// camera otherwise cancels part of the camera's share, too, so this is on the safe side.
[[nodiscard]] Result<math::Matrix6d> calibration_covariance(
    const PoseModel& model, const picture::RimList& rims, const PoseEstimate& estimate,
    const CalibrationUncertainty& uncertainty, const RimBundleOptions& options,
    PoseWorkspace& workspace);

}  // namespace tubesight::core::pose
