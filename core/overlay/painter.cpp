#include "core/overlay/painter.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "core/base/assert.h"
#include "core/overlay/font.h"

namespace tubesight::core::overlay {
namespace {

// Far outside any picture, and far enough from the ends of 32 bits for sums of a few of them.
constexpr std::int32_t kFarthest_px = 1 << 24;

std::int32_t limited(std::int32_t coordinate) {
  return std::clamp(coordinate, -kFarthest_px, kFarthest_px);
}

PixelPoint limited(PixelPoint point) { return {limited(point.u_px), limited(point.v_px)}; }

// a / b to the nearest integer, halves upwards; b > 0.
std::int64_t rounded_quotient(std::int64_t a, std::int64_t b) {
  const std::int64_t doubled = 2 * a + b;
  const std::int64_t quotient = doubled / (2 * b);
  return doubled % (2 * b) < 0 ? quotient - 1 : quotient;
}

}  // namespace

Painter::Painter(const RgbImageView& picture) : picture_(picture) {
  TUBESIGHT_ASSERT(picture.pixels != nullptr);
  TUBESIGHT_ASSERT(picture.width_px > 0 && picture.width_px <= kFarthest_px);
  TUBESIGHT_ASSERT(picture.height_px > 0 && picture.height_px <= kFarthest_px);
  TUBESIGHT_ASSERT(picture.stride_bytes >= 3 * picture.width_px);
}

void Painter::pixel(PixelPoint at, Rgb colour) {
  fill({at.u_px, at.v_px, at.u_px, at.v_px}, colour);
}

void Painter::fill(const PixelBox& box, Rgb colour) {
  const std::int32_t left = std::max(box.left, 0);
  const std::int32_t right = std::min(box.right, picture_.width_px - 1);
  const std::int32_t top = std::max(box.top, 0);
  const std::int32_t bottom = std::min(box.bottom, picture_.height_px - 1);
  if (left > right) {
    return;
  }
  const bool grey = colour.red == colour.green && colour.green == colour.blue;
  for (std::int32_t v = top; v <= bottom; ++v) {
    std::uint8_t* pixel = picture_.pixels + static_cast<std::ptrdiff_t>(v) * picture_.stride_bytes +
                          3 * static_cast<std::ptrdiff_t>(left);
    if (grey) {
      std::memset(pixel, colour.red, 3 * static_cast<std::size_t>(right - left + 1));
      continue;
    }
    for (std::int32_t u = left; u <= right; ++u) {
      pixel[0] = colour.red;
      pixel[1] = colour.green;
      pixel[2] = colour.blue;
      pixel += 3;
    }
  }
}

void Painter::outline(const PixelBox& box, std::int32_t thickness_px, Rgb colour) {
  if (box.right < box.left || box.bottom < box.top) {
    return;
  }
  const PixelPoint first = limited(PixelPoint{box.left, box.top});
  const PixelPoint last = limited(PixelPoint{box.right, box.bottom});
  const std::int32_t left = first.u_px;
  const std::int32_t top = first.v_px;
  const std::int32_t right = last.u_px;
  const std::int32_t bottom = last.v_px;
  // A frame thicker than half the box fills it and must not reach beyond its other edge.
  const std::int32_t inner = limited(thickness_px) - 1;
  fill({left, top, right, std::min(top + inner, bottom)}, colour);
  fill({left, std::max(bottom - inner, top), right, bottom}, colour);
  fill({left, top, std::min(left + inner, right), bottom}, colour);
  fill({std::max(right - inner, left), top, right, bottom}, colour);
}

void Painter::brush(PixelPoint at, std::int32_t thickness_px, Rgb colour) {
  const std::int32_t before = (thickness_px - 1) / 2;
  const std::int32_t after = thickness_px / 2;
  fill({at.u_px - before, at.v_px - before, at.u_px + after, at.v_px + after}, colour);
}

void Painter::line(PixelPoint from, PixelPoint to, std::int32_t thickness_px, Rgb colour) {
  from = limited(from);
  to = limited(to);
  const std::int32_t thickness = limited(thickness_px);
  const std::int32_t delta_u = to.u_px - from.u_px;
  const std::int32_t delta_v = to.v_px - from.v_px;
  const bool steep = std::abs(delta_v) > std::abs(delta_u);
  const std::int32_t length = steep ? std::abs(delta_v) : std::abs(delta_u);
  if (length == 0) {
    brush(from, thickness, colour);
    return;
  }
  // Steps along the longer side; each step's other coordinate is computed from the line's ends, not
  // from the step before it, so steps outside the picture can be left out without a trace.
  const std::int32_t start = steep ? from.v_px : from.u_px;
  const std::int32_t sign = (steep ? delta_v : delta_u) > 0 ? 1 : -1;
  const std::int32_t lowest = -thickness;
  const std::int32_t highest = (steep ? picture_.height_px : picture_.width_px) + thickness;
  const std::int32_t first_step = std::max(0, sign > 0 ? lowest - start : start - highest);
  const std::int32_t last_step = std::min(length, sign > 0 ? highest - start : start - lowest);
  for (std::int32_t step = first_step; step <= last_step; ++step) {
    const std::int32_t along = start + sign * step;
    const std::int64_t shift =
        rounded_quotient(std::int64_t{steep ? delta_u : delta_v} * step, length);
    const std::int32_t across = static_cast<std::int32_t>((steep ? from.u_px : from.v_px) + shift);
    brush(steep ? PixelPoint{across, along} : PixelPoint{along, across}, thickness, colour);
  }
}

void Painter::cross_hair(PixelPoint center, std::int32_t gap_px, std::int32_t reach_px,
                         std::int32_t thickness_px, Rgb colour) {
  const auto [u, v] = limited(center);
  const std::int32_t gap = limited(gap_px);
  const std::int32_t reach = limited(reach_px);
  // Boxes, not lines: a square brush would reach beyond the arms' ends.
  const std::int32_t before = (limited(thickness_px) - 1) / 2;
  const std::int32_t after = limited(thickness_px) / 2;
  fill({u - reach, v - before, u - gap, v + after}, colour);
  fill({u + gap, v - before, u + reach, v + after}, colour);
  fill({u - before, v - reach, u + after, v - gap}, colour);
  fill({u - before, v + gap, u + after, v + reach}, colour);
}

void Painter::diagonal_cross(PixelPoint center, std::int32_t reach_px, std::int32_t thickness_px,
                             Rgb colour) {
  const auto [u, v] = limited(center);
  const std::int32_t reach = limited(reach_px);
  line({u - reach, v - reach}, {u + reach, v + reach}, thickness_px, colour);
  line({u - reach, v + reach}, {u + reach, v - reach}, thickness_px, colour);
}

void Painter::circle(PixelPoint center, std::int32_t radius_px, Rgb colour) {
  TUBESIGHT_ASSERT(radius_px >= 0 && radius_px <= 4096);
  const auto [u, v] = limited(center);
  // One octant, from the top to the diagonal; y is the larger coordinate. The next pixel keeps y
  // while the midpoint below it, (x, y - 1/2), lies inside: x^2 + y^2 - y < r^2.
  std::int32_t y = radius_px;
  for (std::int32_t x = 0; x <= y; ++x) {
    if (x * x + y * y - y >= radius_px * radius_px && y > 0) {
      --y;
    }
    if (x > y) {
      break;
    }
    pixel({u + x, v + y}, colour);
    pixel({u - x, v + y}, colour);
    pixel({u + x, v - y}, colour);
    pixel({u - x, v - y}, colour);
    pixel({u + y, v + x}, colour);
    pixel({u - y, v + x}, colour);
    pixel({u + y, v - x}, colour);
    pixel({u - y, v - x}, colour);
  }
}

void Painter::ring(PixelPoint center, std::int32_t inner_px, std::int32_t outer_px, Rgb colour) {
  TUBESIGHT_ASSERT(inner_px >= 0 && inner_px <= outer_px && outer_px <= 4096);
  const auto [u, v] = limited(center);
  // Twice the distances, so that the halves are whole numbers; 4 * 2 * 4097^2 fits 32 bits.
  const std::int32_t nearest = (2 * inner_px - 1) * (2 * inner_px - 1);
  const std::int32_t farthest = (2 * outer_px + 1) * (2 * outer_px + 1);
  for (std::int32_t dv = -outer_px; dv <= outer_px; ++dv) {
    for (std::int32_t du = -outer_px; du <= outer_px; ++du) {
      const std::int32_t distance = 4 * (du * du + dv * dv);
      if (distance <= farthest && (inner_px == 0 || distance >= nearest)) {
        pixel({u + du, v + dv}, colour);
      }
    }
  }
}

void Painter::text(PixelPoint top_left, std::string_view words, std::int32_t scale, Rgb colour) {
  TUBESIGHT_ASSERT(scale >= 1 && scale <= kLargestTextScale);
  const PixelPoint corner = limited(top_left);
  std::int32_t left = corner.u_px;
  for (const char character : words) {
    if (left >= picture_.width_px) {
      return;
    }
    const Glyph& glyph = glyph_of(character);
    for (std::int32_t row = 0; row < kGlyphHeight; ++row) {
      for (std::int32_t column = 0; column < kGlyphWidth; ++column) {
        if (glyph.dot(column, row)) {
          const std::int32_t u = left + column * scale;
          const std::int32_t v = corner.v_px + row * scale;
          fill({u, v, u + scale - 1, v + scale - 1}, colour);
        }
      }
    }
    left += kCellWidth * scale;
  }
}

}  // namespace tubesight::core::overlay
