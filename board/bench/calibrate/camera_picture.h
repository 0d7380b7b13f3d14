#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/calibration/camera_calibration.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::board {

/// One view as it was seen, small: for a person to see which dots were found.
struct ViewThumb {
  std::string name;           ///< its first picture, or its points file
  std::int32_t width_px = 0;  ///< 0: a points file has no picture
  std::int32_t height_px = 0;
  std::vector<std::uint8_t> grey;
};

/// A picture at the width of a thumb.
[[nodiscard]] ViewThumb make_thumb(const std::string& name,
                                   const core::picture::AveragedPicture& picture);

/// What `calibrate camera --picture` draws.
struct CameraPicture {
  const core::calibration::CalibrationData& data;
  const core::calibration::CalibrationState& state;
  const core::calibration::CalibrationOutcome& outcome;
  std::span<const ViewThumb> views;
  std::vector<std::string> caption;  ///< lines below
};

/// Draws the camera's picture with how well the map is known at each place as colours, all dots
/// with their residuals as arrows, and where the map is worst; below, each view with the dots found
/// and their first line. False, with one line in `message`, when it cannot be written.
[[nodiscard]] bool write_camera_picture(const std::string& path, const CameraPicture& picture,
                                        std::string& message);

}  // namespace tubesight::board
