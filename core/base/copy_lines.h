#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/base/image_view.h"

namespace tubesight::core {

/// Copies the lines of a field closed up, one right behind the other, to where there is room for
/// `from.lines * from.width_px` pixels.
inline void copy_lines(const FieldView& from, std::uint8_t* to) {
  const auto width = static_cast<std::size_t>(from.width_px);
  for (std::int32_t line = 0; line < from.lines; ++line) {
    to = std::copy_n(from.pixels + static_cast<std::ptrdiff_t>(line) * from.stride_px, width, to);
  }
}

/// The same, and the view of the copy: where its lines stand in the frame stays as it is.
[[nodiscard]] inline FieldView copied_lines(const FieldView& from, std::uint8_t* to) {
  copy_lines(from, to);
  FieldView copy = from;
  copy.pixels = to;
  copy.stride_px = from.width_px;
  return copy;
}

}  // namespace tubesight::core
