#include "board/bench/calibrate/tool_dockings.h"

#include "board/bench/pose/pose_words.h"
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

bool DockedPoses::open(const core::SessionSettings& settings, std::string& message) {
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
  averager_ = std::make_unique<StillAverager>(settings.camera);
  workspace_ = std::make_unique<core::pose::PictureWorkspace>();
  return true;
}

DockedPose DockedPoses::find(const DockedPictures& docking, const PictureStarts& starts) {
  DockedPose result;
  const StillsRead read = averager_->read(stills_of(docking.pictures, {}));
  if (read.status != ExitStatus::kDone) {
    result.status = read.status;
    result.message = read.message;
    return result;
  }
  const core::pose::PictureOutcome outcome =
      core::pose::estimate_from_picture(read.picture, model_, map_, starts, {}, *workspace_);
  if (!outcome.has_value()) {
    result.status = ExitStatus::kJobFailed;
    result.message = docking.pictures.front() + ": " + explain(outcome, starts);
    return result;
  }
  const core::pose::PoseEstimate& estimate = outcome.pose.estimate;
  result.T_sheet_camera = {estimate.T_sheet_tool.rotation(),
                           estimate.T_sheet_tool.translation_mm()};
  result.covariance = estimate.covariance;
  result.tubes = estimate.tubes;
  result.rms_px = estimate.rms_px;
  return result;
}

}  // namespace tubesight::board
