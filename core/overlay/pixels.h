#pragma once

#include <cstdint>

#include "core/base/image_view.h"
#include "core/base/sighting.h"

namespace tubesight::core::overlay {

/// A colour, eight bits a channel.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

/// A pixel of the full frame; may lie outside the picture.
struct PixelPoint {
  std::int32_t u_px = 0;
  std::int32_t v_px = 0;

  friend constexpr bool operator==(const PixelPoint&, const PixelPoint&) = default;
};

/// The pixel nearest to a point, at most half a pixel away; halves go right and down.
///
/// Halves go the same way on both sides of zero, so that a mark that leaves the picture on the left
/// moves as evenly as anywhere else. The result lies within -32768 .. 32768 px.
[[nodiscard]] constexpr PixelPoint nearest_pixel(ImagePoint point) {
  const auto nearest = [](std::int32_t q16) {
    constexpr std::int64_t kHalf = 1 << 15;
    return static_cast<std::int32_t>((std::int64_t{q16} + kHalf) >> 16);
  };
  return {nearest(point.u_q16), nearest(point.v_q16)};
}

}  // namespace tubesight::core::overlay
