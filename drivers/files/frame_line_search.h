#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tubesight::drivers {

/// Looks for a FRAME line ("FRAME", then a line feed or a blank) in bytes that come in parts.
///
/// Such a line among the bytes of a frame, or behind what should be one, tells that bytes are
/// missing or too many; pixels hardly ever spell it. Cost: that of memchr() where few bytes are
/// 'F'.
class FrameLineSearch {
 public:
  /// Looks through the next part.
  void look_through(std::span<const std::byte> part);

  /// How many bytes stand before the first FRAME line; -1 while there is none.
  [[nodiscard]] std::int64_t found_at() const { return found_at_; }

  /// Bytes looked through.
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }

 private:
  std::int64_t bytes_ = 0;
  std::int64_t found_at_ = -1;
  std::size_t matched_ = 0;  ///< bytes of the line that the last part ended with
};

}  // namespace tubesight::drivers
