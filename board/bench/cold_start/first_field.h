#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/settings.h"
#include "core/picture/averaged_picture.h"
#include "drivers/replay/replay_frame_grabber.h"

namespace tubesight::board {

/// One field of a recording as a picture, or why there is none.
struct RecordedField {
  std::vector<std::uint16_t> sums;  ///< holds the picture
  core::picture::AveragedPicture picture;
  std::string message;  ///< one line that begins with the recording's name; empty: all is well
};

/// Reads the first field of a frame, the lines of the other one filled in between: the tool may
/// move, and a start counts in that field.
[[nodiscard]] RecordedField read_first_field(const core::CameraSettings& camera,
                                             const std::string& recording, std::int64_t frame,
                                             bool ignore_scan_flag);

/// The same by a grabber of that recording that was told how to read it, and not started.
[[nodiscard]] RecordedField read_first_field(drivers::ReplayFrameGrabber& grabber,
                                             const core::CameraSettings& camera,
                                             const std::string& recording, std::int64_t frame);

}  // namespace tubesight::board
