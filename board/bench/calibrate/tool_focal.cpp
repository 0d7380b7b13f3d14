#include "board/bench/calibrate/tool_focal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "board/bench/calibrate/camera_text.h"
#include "board/bench/pose/calibration_quality.h"
#include "core/calibration/imaging.h"
#include "core/calibration/tip_uncertainty.h"
#include "core/tubesheet/sheet_places.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::calibration::DockingFocal;
using Step = core::calibration::FocalWalk::Step;

constexpr double kMostMap_px = 3.0;
constexpr double kWrongFocal_px = 4.0;  // residuals that a wrong EFL may leave
// Where the type's EFL makes no pose: those around it.
constexpr std::array<double, 7> kTries = {1.0, 0.98, 1.02, 0.96, 1.04, 0.93, 1.07};

/// One search; its members are the arguments of free_focal().
class FocalSearch {
 public:
  FocalSearch(DockedPoses& poses, std::span<const DockedPictures> dockings,
              std::span<const PictureStarts> starts, ProgressLine& progress)
      : poses_(poses), dockings_(dockings), starts_(starts), progress_(progress) {}

  FreedFocal run(const core::math::Matrix6d& type) {
    const double given_mm = poses_.model().camera_settings.focal_length_mm;
    DockedPose failed;
    bool found = false;
    for (const double ratio : kTries) {
      if (poses_.take_focal_length(ratio * given_mm) && round(kWrongFocal_px)) {
        found = true;
        break;
      }
      failed = ratio == 1.0 ? failed_ : failed;
    }
    if (!found) {
      return refused(failed.status == ExitStatus::kDone ? ExitStatus::kJobFailed : failed.status,
                     failed.message.empty() ? undetermined() : failed.message);
    }
    core::calibration::FocalWalk walk(given_mm);
    for (;;) {
      const double before_mm = poses_.model().camera_settings.focal_length_mm;
      const Step step = walk.take(focal_, before_mm);
      if (step == Step::kRestless) {
        return refused(ExitStatus::kJobFailed, restless(before_mm));
      }
      if (step == Step::kElsewhere || !poses_.take_focal_length(focal_.focal_length_mm)) {
        return refused(ExitStatus::kJobFailed, undetermined());
      }
      if (step == Step::kSettled) {
        focal_.sigma_mm = std::hypot(focal_.sigma_mm, walk.change_mm());
        break;
      }
      if (!round(kWrongFocal_px)) {
        return refused(
            failed_.status == ExitStatus::kDone ? ExitStatus::kJobFailed : failed_.status,
            failed_.message.empty() ? undetermined() : failed_.message);
      }
    }
    return judged(type);
  }

 private:
  static FreedFocal refused(ExitStatus status, std::string message) {
    FreedFocal result;
    result.status = status;
    result.message = std::move(message);
    return result;
  }

  static std::string undetermined() {
    return "no calibration: the docked pictures do not tell the EFL within a tenth of that given, "
           "expected a camera that looks aslant at the sheet, seven tube-ends or more, and its own "
           "type's [camera]";
  }

  [[nodiscard]] std::string restless(double with_mm) const {
    std::string text;
    drivers::print(text,
                   "no calibration: the EFL does not come to rest: measured with %.4f mm it comes "
                   "out as %.4f +- %.4f mm, expected the same; more dockings, or tube-ends in "
                   "better light",
                   with_mm, focal_.focal_length_mm, focal_.sigma_mm);
    return text;
  }

  /// Measures all dockings with the present EFL; false, and why in `failed_`, where one has no pose
  /// or no EFL.
  bool round(double most_rms_px) {
    failed_ = {};
    std::vector<DockingFocal> list;
    for (std::size_t i = 0; i < dockings_.size(); ++i) {
      std::string words;
      drivers::print(words, "EFL %.4f mm: docking %d of %d",
                     poses_.model().camera_settings.focal_length_mm, static_cast<int>(i + 1),
                     static_cast<int>(dockings_.size()));
      progress_.update(ProgressLine::Clock::now(), words);
      const DockedPose pose = poses_.find(dockings_[i], starts_[i], most_rms_px);
      if (pose.status != ExitStatus::kDone) {
        failed_ = pose;
        return false;
      }
      list.push_back(poses_.focal());
      if (!list.back().solved) {
        return false;
      }
    }
    focal_ = core::calibration::combined_focal(list);
    return true;
  }

  FreedFocal judged(const core::math::Matrix6d& type) const {
    FreedFocal result;
    result.focal = focal_;
    result.covariance = core::calibration::camera_covariance(focal_, type);
    const core::CameraSettings& camera = poses_.model().camera_settings;
    result.map = core::calibration::map_beside_turn(core::calibration::sensor_of(camera),
                                                    values_of(camera), result.covariance);
    const double sigma_mm = std::sqrt(result.covariance(0, 0));
    if (!(sigma_mm <= core::calibration::FocalWalk::kMostChange * camera.focal_length_mm)) {
      return refused(ExitStatus::kJobFailed,
                     "no calibration: the docked pictures leave EFL and distance open, as a camera "
                     "does that looks square at the sheet, expected one that looks aslant at it, "
                     "or a camera calibrated with a template");
    }
    if (!(result.map.rms_px <= kMostMap_px)) {
      result.status = ExitStatus::kJobFailed;
      drivers::print(result.message,
                     "no calibration: docked so, the EFL is known to %.3f mm and the map from "
                     "pixels to rays to %.1f px only, expected 3 px: more dockings, a type whose "
                     "cameras differ less (sigma in [camera_quality]), or a template",
                     sigma_mm, result.map.rms_px);
    }
    return result;
  }

  DockedPoses& poses_;
  std::span<const DockedPictures> dockings_;
  std::span<const PictureStarts> starts_;
  ProgressLine& progress_;
  DockingFocal focal_;
  DockedPose failed_;
};

}  // namespace

FreedFocal free_focal(DockedPoses& poses, std::span<const DockedPictures> dockings,
                      std::span<const PictureStarts> starts,
                      const drivers::CalibrationQuality& type, ProgressLine& progress) {
  return FocalSearch(poses, dockings, starts, progress).run(covariance_of(type));
}

double tip_by_freed(const FreedFocal& freed, const core::CameraSettings& camera,
                    const core::Transform<core::frames::Camera, core::frames::Tool>& T,
                    const core::TubesheetSettings& sheet) {
  core::calibration::TipSituation situation;
  const auto lengths_mm = core::tubesheet::step_lengths_mm(sheet);
  situation.pitch_mm = std::min(lengths_mm[0], lengths_mm[1]);
  situation.tip_mm = T.translation_mm();
  situation.R_camera_tool = T.rotation();
  const auto tip =
      core::calibration::tip_uncertainty(core::calibration::sensor_of(camera), values_of(camera),
                                         freed.covariance, situation, kFreedGap_mm);
  return tip.told() ? tip.across_mm : -1.0;
}

}  // namespace tubesight::board
