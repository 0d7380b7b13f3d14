#pragma once

#include <string>

#include "board/bench/output/exit_status.h"
#include "core/base/settings.h"

namespace tubesight::board {

/// A calibrated camera as OpenCV or ROS take it.
struct CameraExport {
  std::string text;    ///< of the file
  std::string report;  ///< a line for a person: what the other distortion model does not follow
};

/// Converts a camera; `opencv`: in the manner of cv::FileStorage, else of ROS.
[[nodiscard]] CameraExport export_camera(const core::CameraSettings& camera,
                                         const std::string& serial, bool opencv);

/// The arguments of `tubesight calibrate import`; an empty path is one that was not given.
struct ImportCameraOptions {
  std::string file;
  std::string out;
};

/// The camera of a file of OpenCV, ROS or Kalibr, progressive, with cells of 0.01 mm. `report` is
/// one line of what the conversion costs. Anything but kDone was told on standard error.
[[nodiscard]] ExitStatus import_camera(const std::string& file, core::CameraSettings& camera,
                                       std::string& report);

/// `tubesight calibrate import`: settings of a camera from a file of OpenCV, ROS or Kalibr.
///
/// What the conversion costs goes to standard output, `[camera]` to `out`. Its cells count as
/// 0.01 mm, as such a file has no millimetres: only ratios matter. A conversion that is more than
/// 1 px off over the picture (RMS), and models that are no lens of this kind, are refused.
[[nodiscard]] ExitStatus run_import_camera(const ImportCameraOptions& options);

}  // namespace tubesight::board
