#pragma once

#include <algorithm>
#include <cstdint>

namespace tubesight::core::overlay {

/// How large marks are drawn: with the picture, so that they look the same on any screen.
///
/// Lengths are stated for a picture of 640 px in width, which shows tube-ends of some 40 to 80 px.
class MarkScale {
 public:
  explicit constexpr MarkScale(std::int32_t width_px) : width_px_(width_px) {}

  /// A length in pixels of this picture, to the nearest one and 1 at least; `length` 0..1000.
  [[nodiscard]] constexpr std::int32_t px(std::int32_t length) const {
    const std::int64_t scaled = (std::int64_t{length} * width_px_ + kStated_px / 2) / kStated_px;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(scaled, 1, kLargest_px));
  }

  /// Pixels a dot of letters beside marks, 1 or more.
  [[nodiscard]] constexpr std::int32_t text() const { return std::clamp(width_px_ / 635, 1, 16); }

 private:
  static constexpr std::int32_t kStated_px = 640;
  static constexpr std::int64_t kLargest_px = 2048;

  std::int32_t width_px_;
};

}  // namespace tubesight::core::overlay
