#include "board/bench/calibrate/tool_focal.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/calibration/imaging.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::calibration::DockingFocal;

constexpr int kMostRounds = 12;
constexpr double kSettled = 0.05;       // of a standard deviation
constexpr double kMostChange = 0.1;     // of the type's EFL; beyond, it is another type
constexpr double kMostMap_px = 1.0;     // as of a camera calibrated with a template
constexpr double kWrongFocal_px = 4.0;  // residuals that a wrong EFL may leave
// Where the type's EFL makes no pose: those around it.
constexpr std::array<double, 7> kTries = {1.0, 0.98, 1.02, 0.96, 1.04, 0.93, 1.07};

core::math::Matrix6d covariance_of(const drivers::CalibrationQuality& type) {
  core::math::Matrix6d covariance = core::math::Matrix6d::Zero();
  for (int i = 0; type.has_sigma && i < 6; ++i) {
    for (int k = 0; k < 6; ++k) {
      covariance(i, k) = type.correlation[static_cast<std::size_t>(6 * i + k)] *
                         type.sigma[static_cast<std::size_t>(i)] *
                         type.sigma[static_cast<std::size_t>(k)];
    }
  }
  return covariance;
}

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
    bool settled = false;
    for (int i = 0; i < kMostRounds && !settled; ++i) {
      const double before_mm = poses_.model().camera_settings.focal_length_mm;
      const double change_mm = focal_.focal_length_mm - before_mm;
      settled = std::abs(change_mm) < kSettled * focal_.sigma_mm;
      if (!(std::abs(focal_.focal_length_mm / given_mm - 1.0) < kMostChange) ||
          !poses_.take_focal_length(focal_.focal_length_mm)) {
        return refused(ExitStatus::kJobFailed, undetermined());
      }
      if (!settled && !round(kWrongFocal_px)) {
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
    core::calibration::CameraValues values;
    values << camera.focal_length_mm, camera.horizontal_scale, camera.center_px[0],
        camera.center_px[1], camera.distortion_per_mm2, camera.distortion2_per_mm4;
    result.map = core::calibration::map_beside_turn(core::calibration::sensor_of(camera), values,
                                                    result.covariance);
    const double sigma_mm = std::sqrt(result.covariance(0, 0));
    if (!(sigma_mm <= kMostChange * camera.focal_length_mm)) {
      return refused(ExitStatus::kJobFailed,
                     "no calibration: the docked pictures leave EFL and distance open, as a camera "
                     "does that looks square at the sheet, expected one that looks aslant at it, "
                     "or a camera calibrated with a template");
    }
    if (!(result.map.rms_px <= kMostMap_px)) {
      result.status = ExitStatus::kJobFailed;
      drivers::print(result.message,
                     "no calibration: docked so, the EFL is known to %.3f mm and the map from "
                     "pixels to rays to %.1f px only, expected 1 px: more dockings, a type whose "
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

}  // namespace tubesight::board
