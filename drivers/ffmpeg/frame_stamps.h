#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/files/frame_stamp.h"

namespace tubesight::drivers {

/// The time stamps of a video's frames, read from what ffmpeg's muxer `framecrc` writes: a line
/// "#tb 0: 1/12800" with the unit, then one line a frame, whose third number is its stamp.
class FrameStamps {
 public:
  /// Takes the next bytes, in parts of any size.
  void take(std::string_view part);

  /// Whether a frame's line has come that next() has not given yet.
  [[nodiscard]] bool ready() const { return !stamps_.empty(); }

  /// The stamp of the next frame; none when it has none, or its line has not come.
  [[nodiscard]] std::optional<FrameStamp> next();

 private:
  void take_line();

  std::string line_;
  std::int64_t numerator_ = 0;  ///< of the unit, s; 0: not told
  std::int64_t denominator_ = 1;
  std::deque<std::optional<FrameStamp>> stamps_;
};

}  // namespace tubesight::drivers
