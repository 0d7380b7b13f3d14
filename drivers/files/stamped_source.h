#pragma once

#include <optional>

#include "drivers/files/byte_source.h"
#include "drivers/files/frame_stamp.h"

namespace tubesight::drivers {

/// A recording's bytes, from where each frame's time is told beside them.
class StampedSource : public ByteSource {
 public:
  /// The stamp of the next frame; none when it has none. Call once a frame, in order, after that
  /// frame's bytes were read. May wait for it.
  [[nodiscard]] virtual std::optional<FrameStamp> next_stamp() = 0;
};

}  // namespace tubesight::drivers
