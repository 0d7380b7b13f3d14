#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/v4l2/camera_setup.h"

namespace tubesight::drivers::v4l2 {

/// Finds the lines of a buffer that a driver handed out without writing them.
///
/// A driver that loses a packet of its grabber, or a whole picture, may hand the buffer out all the
/// same, without a flag: what stands there is of some buffers ago, an old picture that looks well.
/// So each buffer goes to the driver with a mark in its lines, eight bytes of 0 and 255 in an order
/// that no lens and no sheet draws; one that is still there when the buffer comes back lies in a
/// line that nobody wrote. A mark in vain costs nothing: where the memory is not what the driver
/// writes to, none is ever found. No heap.
class WriteMarks {
 public:
  /// Lines of a field that have a mark, at most: of one that has more, each second, or up to
  /// each tenth of 1200.
  static constexpr std::int32_t kMostLines = 120;
  static constexpr std::int32_t kBytes = 8;

  /// Pictures are of this format, `width_px` wide.
  void begin(const AgreedFormat& agreed, std::int32_t width_px);

  /// Into the memory of a picture, before the driver gets it.
  void lay(std::byte* picture) const;

  /// Whether one is left in the lines of a field.
  [[nodiscard]] bool left(const std::byte* picture, const FieldLines& field) const;

 private:
  [[nodiscard]] std::ptrdiff_t place_in(std::int32_t line) const;

  AgreedFormat agreed_;
  std::int32_t edge_bytes_ = 0;  ///< before the first place in a line
  std::int32_t places_ = 0;      ///< in a line; 0: it is too short for any
};

}  // namespace tubesight::drivers::v4l2
