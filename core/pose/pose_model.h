#pragma once

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/base/transform.h"
#include "core/camera/camera_model.h"
#include "core/tubesheet/lattice.h"
#include "core/tubesheet/tubesheet_setup.h"

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
    const auto at = tubesheet::center_mm(lattice, {origin_mm.x(), origin_mm.y()}, address);
    return {at[0], at[1]};
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
