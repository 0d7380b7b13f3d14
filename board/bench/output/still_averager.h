#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "board/bench/output/exit_status.h"
#include "board/bench/output/still_reader.h"
#include "core/base/settings.h"
#include "core/picture/averaged_picture.h"
#include "core/picture/rest_average.h"
#include "drivers/files/picture_reader.h"

namespace tubesight::board {

/// What became of the stills of one pose.
struct StillsRead {
  ExitStatus status = ExitStatus::kDone;  ///< kJobFailed: the camera moved
  std::string message;  ///< why not kDone, one line that begins with a file's name
  core::picture::AveragedPicture picture;  ///< valid until the next call
  double frame_shift_px = 0.0;             ///< largest between frames
  double field_shift_px = 0.0;             ///< largest between the fields
};

/// Reads stills of one place and averages them, with the check that nothing moved between them nor,
/// where the camera is interlaced, between their two fields.
class StillAverager {
 public:
  /// With `ignore_scan_flag` the settings say the order of lines, whatever a recording's flag says.
  explicit StillAverager(const core::CameraSettings& camera, bool ignore_scan_flag = false);

  [[nodiscard]] StillsRead read(std::span<const Still> stills);

  /// The last still read, to draw on.
  [[nodiscard]] core::ImageView picture() const { return picture_.view(); }

 private:
  bool add(const Still& still, core::picture::RestAverage& average, StillsRead& result);

  core::CameraSettings camera_;
  bool ignore_scan_flag_;
  std::vector<std::uint16_t> sums_;
  StillReader reader_;
  drivers::GreyPicture picture_;
};

}  // namespace tubesight::board
