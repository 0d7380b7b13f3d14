#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/image_view.h"

namespace tubesight::core::edges {

/// A straight walk over the pixels of one field, with the two separated paths beside it that the
/// gradient operators read [Fallon 6.2.1].
///
/// Position i is the pixel `origin + i * step`; the two paths run `side` to either side of it. A
/// horizontal path goes along a line of the field, its two paths are the lines above and below (v±2
/// of an interlaced frame); a vertical one goes along a column, its two paths are columns u±2.
struct EdgePath {
  const std::uint8_t* origin = nullptr;
  std::ptrdiff_t step = 1;
  std::ptrdiff_t side = 0;

  [[nodiscard]] std::int32_t pixel(std::int32_t position) const { return origin[position * step]; }
  [[nodiscard]] std::int32_t pair(std::int32_t position) const {
    const std::uint8_t* p = origin + position * step;
    return std::int32_t{p[-side]} + std::int32_t{p[side]};
  }
};

/// Every `step`-th position of a path, of which `offset` is the first.
[[nodiscard]] inline EdgePath every(const EdgePath& path, std::int32_t step, std::int32_t offset) {
  return {path.origin + offset * path.step, path.step * step, path.side};
}

/// The path along line `line` of the field, positions are columns. Needs 1 <= line < lines - 1.
[[nodiscard]] inline EdgePath horizontal_path(const FieldView& field, std::int32_t line) {
  return {field.pixels + static_cast<std::ptrdiff_t>(line) * field.stride_px, 1, field.stride_px};
}

/// The path along column `column`, positions are lines of the field. Needs 2 <= column < width - 2.
[[nodiscard]] inline EdgePath vertical_path(const FieldView& field, std::int32_t column) {
  return {field.pixels + column, field.stride_px, 2};
}

}  // namespace tubesight::core::edges
