#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/image_view.h"
#include "core/base/result.h"
#include "drivers/files/y4m_header.h"

namespace tubesight::board {

/// Takes the overlay pictures of a replay, one a field, in order.
///
/// Nothing that looks whole is left behind unless commit() succeeds: destruction removes what was
/// written. Errors are kIo, and message() tells in one line.
class OverlaySink {
 public:
  virtual ~OverlaySink() = default;

  /// Prepares the place. `recording` gives the rate of frames and the size of the pictures.
  [[nodiscard]] virtual core::Result<void> open(const drivers::Y4mHeader& recording,
                                                bool interlaced) = 0;
  /// Takes the picture of the field with this number.
  [[nodiscard]] virtual core::Result<void> add(std::int64_t field,
                                               const core::RgbImageView& picture) = 0;
  /// Puts all pictures in their place.
  [[nodiscard]] virtual core::Result<void> commit() = 0;

  [[nodiscard]] virtual const std::string& message() const = 0;
};

/// What `--overlay OUT` asks for by OUT's ending in any case: a video when it is ".y4m", one that
/// ffmpeg encodes when it is ".mp4", ".mkv" or ".mov", and a folder otherwise.
[[nodiscard]] std::unique_ptr<OverlaySink> make_overlay_sink(const std::string& out);

}  // namespace tubesight::board
