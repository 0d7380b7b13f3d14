#pragma once

#include <string>

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight calibrate camera`; an empty path is one that was not given.
struct CalibrateCameraOptions {
  std::string target;
  std::string out;
  std::string picture;
  std::string exported;   ///< for OpenCV or ROS
  bool opencv = false;    ///< in the manner of cv::FileStorage
  std::string residuals;  ///< a table of all dots
  std::string points;     ///< a folder for what the pictures show
  bool ignore_scan_flag = false;
  bool type = false;  ///< for cameras of this type that have no calibration of their own
};

/// `tubesight calibrate camera`: the camera's internal parameters from views of a dot template.
///
/// `picture` shows views, residuals and the map's uncertainty, `residuals` has each dot's; also of
/// what is refused once the dots are found. Parameters, their uncertainty and the verdict go to
/// standard output; the settings to `out`, whose former content is kept as `out.bak`. A calibration
/// that cannot be made, or whose map is too uncertain for anything, gives one line on standard
/// error and status kJobFailed, and no settings; what the pictures show is written all the same.
[[nodiscard]] ExitStatus run_calibrate_camera(const CalibrateCameraOptions& options);

}  // namespace tubesight::board
