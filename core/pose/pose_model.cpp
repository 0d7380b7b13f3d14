#include "core/pose/pose_model.h"

#include "core/camera/camera_setup.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::core::pose {

Transform<frames::Camera, frames::Tool> tool_transform(const ToolSettings& tool) {
  return {rotation_from_degrees(tool.rotation_deg),
          Eigen::Vector3d(tool.position_mm[0], tool.position_mm[1], tool.position_mm[2])};
}

Result<PoseModel> make_pose_model(const CameraSettings& camera, const ToolSettings& tool,
                                  const TubesheetSettings& tubesheet) {
  const auto camera_model = camera::make_camera_model<double>(camera);
  if (!camera_model) {
    return Unexpected(camera_model.error());
  }
  const auto lattice = tubesheet::make_lattice<double>(tubesheet);
  if (!lattice) {
    return Unexpected(lattice.error());
  }
  if (!(tubesheet.bore_mm > 0.0)) {
    return Unexpected(Error::kOutOfRange);
  }
  PoseModel model;
  model.camera_settings = camera;
  model.camera = *camera_model;
  model.T_camera_tool = tool_transform(tool);
  model.lattice = *lattice;
  model.origin_mm = {tubesheet.origin_mm[0], tubesheet.origin_mm[1]};
  model.bore_mm = tubesheet.bore_mm;
  return model;
}

}  // namespace tubesight::core::pose
