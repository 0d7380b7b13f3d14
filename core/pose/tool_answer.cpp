#include "core/pose/tool_answer.h"

#include <cmath>

#include "core/math/rotation.h"

namespace tubesight::core::pose {

Transform<frames::Sheet, frames::Tool> tool_pose(
    const Transform<frames::Camera, frames::Sheet>& T_camera_sheet,
    const Transform<frames::Camera, frames::Tool>& T_camera_tool) {
  return T_camera_sheet.inverse() * T_camera_tool;
}

math::Matrix6d tool_covariance(const math::Matrix6d& camera_covariance,
                               const Transform<frames::Camera, frames::Sheet>& T_camera_sheet,
                               const Transform<frames::Camera, frames::Tool>& T_camera_tool) {
  const Eigen::Matrix3d back = -T_camera_sheet.rotation().transpose();
  const Eigen::Vector3d arm = T_camera_tool.translation_mm() - T_camera_sheet.translation_mm();
  math::Matrix6d J = math::Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = back;
  J.topRightCorner<3, 3>() = -back * math::skew(arm);
  J.bottomRightCorner<3, 3>() = back;
  const math::Matrix6d half = J.lazyProduct(camera_covariance);
  return half.lazyProduct(J.transpose());
}

TubeOffset offset_from(const PoseModel& model,
                       const Transform<frames::Sheet, frames::Tool>& T_sheet_tool,
                       TubeAddress address) {
  const Eigen::Vector3d axis = T_sheet_tool.rotation().col(2);
  const Eigen::Vector3d& tip = T_sheet_tool.translation_mm();
  const Eigen::Vector2d center = model.center_mm(address);
  TubeOffset offset;
  offset.address = address;
  offset.axis_mm = tip.head<2>() - axis.head<2>() * (tip.z() / axis.z());
  offset.tip_mm = {tip.x() - center.x(), tip.y() - center.y(), tip.z()};
  offset.offset_mm = offset.axis_mm - center;
  offset.distance_mm = offset.offset_mm.norm();
  offset.tilt_rad = std::atan2(axis.head<2>().norm(), axis.z());
  return offset;
}

TubeOffset offset_from_nearest(const PoseModel& model,
                               const Transform<frames::Sheet, frames::Tool>& T_sheet_tool) {
  // An address that exists: (0, 0), or its neighbour where every other one is left out.
  const TubeAddress anchor{0, model.lattice.has({0, 0}) ? 0 : 1};
  const TubeOffset from_anchor = offset_from(model, T_sheet_tool, anchor);
  const TubeAddress nearest =
      model.lattice.nearest(anchor, {from_anchor.offset_mm.x(), from_anchor.offset_mm.y()});
  return offset_from(model, T_sheet_tool, nearest);
}

}  // namespace tubesight::core::pose
