#pragma once

#include "core/base/transform.h"
#include "core/base/tube_address.h"
#include "core/math/small_matrix.h"
#include "core/pose/pose_model.h"

namespace tubesight::core::pose {

/// T_sheet_tool = T_camera_sheet^-1 T_camera_tool [Fallon eq. 5.40, 5.42].
[[nodiscard]] Transform<frames::Sheet, frames::Tool> tool_pose(
    const Transform<frames::Camera, frames::Sheet>& T_camera_sheet,
    const Transform<frames::Camera, frames::Tool>& T_camera_tool);

/// The covariance of T_sheet_tool (perturbed on the left in the sheet frame) from that of
/// T_camera_sheet (perturbed on the left in the camera frame), the tool's calibration taken as
/// exact: delta p = -R^T (tau + theta x (t_camera_tool - t_camera_sheet)), delta theta = -R^T
/// theta.
[[nodiscard]] math::Matrix6d tool_covariance(
    const math::Matrix6d& camera_covariance,
    const Transform<frames::Camera, frames::Sheet>& T_camera_sheet,
    const Transform<frames::Camera, frames::Tool>& T_camera_tool);

/// Where the tool points, relative to one tube.
struct TubeOffset {
  TubeAddress address;
  Eigen::Vector2d axis_mm = Eigen::Vector2d::Zero();  ///< where the axis meets the sheet
  Eigen::Vector3d tip_mm = Eigen::Vector3d::Zero();   ///< tip less tube's centre [Fallon eq. 5.41]
  Eigen::Vector2d offset_mm = Eigen::Vector2d::Zero();  ///< of the axis from the tube's centre
  double distance_mm = 0.0;                             ///< its length
  double tilt_rad = 0.0;  ///< between the guidetube's axis and the sheet's normal
};

/// The tool relative to the tube at `address`.
[[nodiscard]] TubeOffset offset_from(const PoseModel& model,
                                     const Transform<frames::Sheet, frames::Tool>& T_sheet_tool,
                                     TubeAddress address);

/// The tool relative to the address of the lattice nearest to the guidetube's axis, whether a tube
/// stands there or not.
[[nodiscard]] TubeOffset offset_from_nearest(
    const PoseModel& model, const Transform<frames::Sheet, frames::Tool>& T_sheet_tool);

}  // namespace tubesight::core::pose
