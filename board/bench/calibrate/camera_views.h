#pragma once

#include <memory>
#include <string>
#include <vector>

#include "board/bench/calibrate/camera_picture.h"
#include "board/bench/output/exit_status.h"
#include "board/bench/output/still_averager.h"
#include "core/calibration/calibration_data.h"
#include "core/calibration/target_order.h"
#include "core/detection/lattice_finder.h"
#include "drivers/settings/target_settings.h"

namespace tubesight::board {

/// Reads the views of a calibration target: averages the pictures of each, finds the dots and gives
/// them their places, or reads a points file.
class CameraViews {
 public:
  /// With `ignore_scan_flag`, as StillAverager.
  CameraViews(const drivers::TargetFile& file, bool ignore_scan_flag);

  /// Appends all views to `data`. kJobFailed: no template in a picture, or a camera that moved;
  /// kWrongInput: a file cannot be used. message() tells in one line.
  [[nodiscard]] ExitStatus read(core::calibration::CalibrationData& data);

  [[nodiscard]] const std::string& message() const { return message_; }
  /// What is to be told of views that are taken all the same, a line each.
  [[nodiscard]] const std::string& notes() const { return notes_; }
  /// Each view as it was seen.
  [[nodiscard]] const std::vector<ViewThumb>& thumbs() const { return thumbs_; }

 private:
  ExitStatus read_images(const drivers::ViewSettings& view,
                         core::calibration::CalibrationData& data);
  ExitStatus read_points(const drivers::ViewSettings& view,
                         core::calibration::CalibrationData& data);
  ExitStatus fail(ExitStatus status, std::string message);

  const drivers::TargetFile& file_;
  core::calibration::Target target_;
  StillAverager averager_;
  std::vector<std::uint16_t> scratch_;
  std::unique_ptr<core::detection::LatticeFinder> finder_ =
      std::make_unique<core::detection::LatticeFinder>();
  std::unique_ptr<core::detection::FoundLattice> found_ =
      std::make_unique<core::detection::FoundLattice>();
  std::vector<ViewThumb> thumbs_;
  std::string message_;
  std::string notes_;
};

}  // namespace tubesight::board
