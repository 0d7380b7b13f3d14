#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/assert.h"

namespace tubesight::core {

/// Which lines of a full frame a picture holds.
enum class Parity : std::uint8_t {
  kEven,         ///< lines 0, 2, 4 … of the frame
  kOdd,          ///< lines 1, 3, 5 … of the frame
  kProgressive,  ///< all lines
};

/// A full-frame 8-bit grey picture that somebody else owns.
struct ImageView {
  const std::uint8_t* pixels = nullptr;  ///< top-left pixel
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::int32_t stride_px = 0;  ///< from one line to the next, at least width_px

  [[nodiscard]] constexpr const std::uint8_t* line(std::int32_t v) const {
    return pixels + static_cast<std::ptrdiff_t>(v) * stride_px;
  }
};

/// A box of full-frame pixels, all four edges belonging to it; empty when right < left or
/// bottom < top.
struct PixelBox {
  std::int32_t left = 0;
  std::int32_t top = 0;
  std::int32_t right = 0;
  std::int32_t bottom = 0;

  friend constexpr bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// A full-frame 8-bit RGB picture (three bytes a pixel) to draw into, owned by the caller.
struct RgbImageView {
  std::uint8_t* pixels = nullptr;  ///< top-left pixel, red first
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::int32_t stride_bytes = 0;  ///< from one line to the next, at least 3 * width_px
};

/// The lines of one field of a full frame, or of a whole progressive frame.
///
/// Line l of the field is line first_line + l * line_step of the frame: the only place, with the
/// pixel loops in core/edges, where half-height coordinates exist.
struct FieldView {
  const std::uint8_t* pixels = nullptr;  ///< first pixel of the field's first line
  std::int32_t width_px = 0;
  std::int32_t lines = 0;
  std::int32_t stride_px = 0;   ///< from one line of the field to the next
  std::int32_t first_line = 0;  ///< frame line of the field's line 0
  std::int32_t line_step = 1;   ///< frame lines between two lines of the field
};

/// The lines of `frame` that belong to `parity`, without copying.
[[nodiscard]] constexpr FieldView field_of(const ImageView& frame, Parity parity) {
  if (parity == Parity::kProgressive) {
    return {frame.pixels, frame.width_px, frame.height_px, frame.stride_px, 0, 1};
  }
  const std::int32_t first = parity == Parity::kOdd ? 1 : 0;
  TUBESIGHT_ASSERT(frame.height_px > first);
  return {frame.line(first),   frame.width_px, (frame.height_px - first + 1) / 2,
          2 * frame.stride_px, first,          2};
}

}  // namespace tubesight::core
