#include "board/bench/calibrate/tool_dockings.h"

#include <array>

#include "board/bench/pose/pose_words.h"
#include "core/camera/camera_setup.h"
#include "core/pose/calibration_uncertainty.h"
#include "drivers/files/csv_reader.h"

namespace tubesight::board {

bool parse_dockings(std::string_view name, const std::vector<std::string>& words,
                    std::vector<DockedPictures>& dockings, std::string& message) {
  for (const std::string& word : words) {
    core::TubeAddress tube;
    if (parse_address(word, tube)) {
      dockings.push_back({tube, {}});
    } else if (dockings.empty()) {
      message = std::string(name) + ": " + drivers::in_quotes(word) +
                ", expected ROW,COLUMN of the tube before its pictures";
      return false;
    } else {
      dockings.back().pictures.push_back(word);
    }
  }
  for (const DockedPictures& docking : dockings) {
    if (docking.pictures.empty()) {
      message = std::string(name) + ": no picture of the docking on tube (" +
                std::to_string(docking.tube.row) + ", " + std::to_string(docking.tube.column) +
                "), expected ROW,COLUMN IMAGE...";
      return false;
    }
  }
  return true;
}

bool DockedPoses::open(const core::SessionSettings& settings, bool ignore_scan_flag,
                       std::string& message) {
  // The tool is what is sought: the camera stands for it.
  const auto model =
      core::pose::make_pose_model(settings.camera, core::ToolSettings{}, settings.tubesheet);
  if (!model || !map_.assign(settings.tubesheet)) {
    message =
        "no pose can be computed with these settings together, expected neighbouring tubes "
        "from 2 mm apart and a picture within 60 degrees of the optical axis";
    return false;
  }
  model_ = *model;
  averager_ = std::make_unique<StillAverager>(settings.camera, ignore_scan_flag);
  workspace_ = std::make_unique<core::pose::PictureWorkspace>();
  return true;
}

bool DockedPoses::take_focal_length(double focal_length_mm) {
  core::CameraSettings camera = model_.camera_settings;
  camera.focal_length_mm = focal_length_mm;
  const auto made = core::camera::make_camera_model<double>(camera);
  if (!made) {
    return false;
  }
  model_.camera_settings = camera;
  model_.camera = *made;
  return true;
}

DockedPose DockedPoses::find(const DockedPictures& docking, const PictureStarts& starts,
                             double most_rms_px) {
  DockedPose result;
  const StillsRead read = averager_->read(stills_of(docking.pictures, {}));
  if (read.status != ExitStatus::kDone) {
    result.status = read.status;
    result.message = read.message;
    return result;
  }
  average_ = read.picture;
  core::pose::PictureOptions options;
  options.pose.max_rms_px = most_rms_px;
  outcome_ =
      core::pose::estimate_from_picture(read.picture, model_, map_, starts, options, *workspace_);
  if (!outcome_.has_value()) {
    result.status = ExitStatus::kJobFailed;
    result.message = docking.pictures.front() + ": " + explain(outcome_, starts);
    return result;
  }
  const core::pose::PoseEstimate& estimate = outcome_.pose.estimate;
  result.T_sheet_camera = {estimate.T_sheet_tool.rotation(),
                           estimate.T_sheet_tool.translation_mm()};
  result.covariance = estimate.covariance;
  result.tubes = estimate.tubes;
  result.rms_px = estimate.rms_px;
  return result;
}

core::calibration::DockingFocal DockedPoses::focal() {
  return core::calibration::focal_by_docking(model_, workspace_->rims, outcome_.pose.estimate,
                                             workspace_->pose);
}

bool DockedPoses::by_focal(core::math::Vector6d& slope) {
  constexpr std::array<double, 6> kSteps = {0.01, 0.0, 0.0, 0.0, 0.0, 0.0};  // mm of EFL
  const auto by_camera = core::pose::camera_sensitivity(
      model_, workspace_->rims, outcome_.pose.estimate, kSteps, {}, workspace_->pose);
  if (!by_camera) {
    return false;
  }
  slope = by_camera->col(0);
  return true;
}

}  // namespace tubesight::board
