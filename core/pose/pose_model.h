#pragma once

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/base/transform.h"
#include "core/camera/camera_model.h"
#include "core/tubesheet/lattice.h"

namespace tubesight::core::pose {

/// What is known before the picture: the camera, the tool and the lattice of tube-ends.
struct PoseModel {
  CameraSettings camera_settings;  ///< what `camera` was made from, for sensitivities
  camera::CameraModel<double> camera;
  Transform<frames::Camera, frames::Tool> T_camera_tool;
  tubesheet::Lattice<double> lattice;
  Eigen::Vector2d origin_mm = Eigen::Vector2d::Zero();  ///< centre of tube (0, 0), sheet frame
  double bore_mm = 0.0;                                 ///< nominal inside diameter

  /// Centre of a tube in the sheet frame, mm.
  [[nodiscard]] Eigen::Vector2d center_mm(TubeAddress address) const {
    const tubesheet::Lattice<double>::Parameters& p = lattice.parameters();
    const double shifted = tubesheet::in_odd_row(address) ? 1.0 : 0.0;
    return origin_mm +
           static_cast<double>(address.row) * Eigen::Vector2d(p.row_step.x, p.row_step.y) +
           static_cast<double>(address.column) * Eigen::Vector2d(p.column_step.x, p.column_step.y) +
           shifted * Eigen::Vector2d(p.odd_row_shift.x, p.odd_row_shift.y);
  }
};

/// The model for the settings; errors are those of make_camera_model() and make_lattice().
/// kOutOfRange also for a bore that is not above zero.
[[nodiscard]] Result<PoseModel> make_pose_model(const CameraSettings& camera,
                                                const ToolSettings& tool,
                                                const TubesheetSettings& tubesheet);

/// T_camera_tool of the table `[tool]`.
[[nodiscard]] Transform<frames::Camera, frames::Tool> tool_transform(const ToolSettings& tool);

}  // namespace tubesight::core::pose
