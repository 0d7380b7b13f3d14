#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "board/bench/output/exit_status.h"
#include "board/bench/output/still_averager.h"
#include "board/bench/pose/pose_starts.h"
#include "core/base/image_view.h"
#include "core/base/settings.h"
#include "core/base/transform.h"
#include "core/base/tube_address.h"
#include "core/calibration/docking_focal.h"
#include "core/math/small_matrix.h"
#include "core/picture/averaged_picture.h"
#include "core/pose/picture_pose.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::board {

/// A docking as it is asked for.
struct DockedPictures {
  core::TubeAddress tube;
  std::vector<std::string> pictures;
};

/// Parts "ROW,COLUMN" and pictures into dockings. False, with one line in `message` that begins
/// with the option's `name`, for anything else.
[[nodiscard]] bool parse_dockings(std::string_view name, const std::vector<std::string>& words,
                                  std::vector<DockedPictures>& dockings, std::string& message);

/// The camera's pose over the sheet in the pictures of a docking.
struct DockedPose {
  ExitStatus status = ExitStatus::kDone;
  std::string message;  ///< why not kDone
  core::Transform<core::frames::Sheet, core::frames::Camera> T_sheet_camera;
  core::math::Matrix6d covariance = core::math::Matrix6d::Zero();
  std::int32_t tubes = 0;
  double rms_px = 0.0;
};

/// Poses of the camera alone, by the tube-ends in averaged pictures.
class DockedPoses {
 public:
  /// Takes over camera and sheet; false, and why in `message`, when they make no pose.
  [[nodiscard]] bool open(const core::SessionSettings& settings, bool ignore_scan_flag,
                          std::string& message);

  /// Goes on with another EFL; false where no camera has it, and the one before stays.
  [[nodiscard]] bool take_focal_length(double focal_length_mm);

  /// `most_rms_px`: what the residuals may be; more than usual where the EFL is not known yet.
  [[nodiscard]] DockedPose find(const DockedPictures& docking, const PictureStarts& starts,
                                double most_rms_px = core::pose::PoseOptions{}.max_rms_px);

  // Of the docking last found.

  /// The EFL by its tube-ends.
  [[nodiscard]] core::calibration::DockingFocal focal();
  /// Derivatives of T_sheet_camera, (tau, theta), by the EFL; false where they can't be told.
  [[nodiscard]] bool by_focal(core::math::Vector6d& slope);
  [[nodiscard]] const core::pose::PictureOutcome& outcome() const { return outcome_; }
  [[nodiscard]] const core::picture::RimList& rims() const { return workspace_->rims; }
  [[nodiscard]] const core::picture::AveragedPicture& average() const { return average_; }
  [[nodiscard]] core::ImageView picture() const { return averager_->picture(); }

  [[nodiscard]] const core::pose::PoseModel& model() const { return model_; }
  [[nodiscard]] bool stands(core::TubeAddress tube) const {
    return map_.state(tube) == core::TubeState::kOpen;
  }

 private:
  core::pose::PoseModel model_;
  core::tubesheet::SheetMap map_;
  std::unique_ptr<StillAverager> averager_;
  std::unique_ptr<core::pose::PictureWorkspace> workspace_;
  core::picture::AveragedPicture average_;
  core::pose::PictureOutcome outcome_;
};

}  // namespace tubesight::board
