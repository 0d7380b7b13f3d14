#include "core/overlay/arrow.h"

#include <algorithm>
#include <limits>

namespace tubesight::core::overlay {
namespace {

constexpr std::int32_t kHeadLength = 11;
constexpr std::int32_t kHeadHalfWidth = 5;

// Largest integer whose square is not above `value`, 0 .. 2^62 - 1; bit by bit, 32 steps.
std::int64_t integer_root(std::int64_t value) {
  std::int64_t root = 0;
  for (std::int64_t bit = std::int64_t{1} << 31; bit != 0; bit >>= 1) {
    const std::int64_t trial = root + bit;
    if (trial * trial <= value) {
      root = trial;
    }
  }
  return root;
}

ImagePoint image_point(std::int64_t u_q16, std::int64_t v_q16) {
  const auto held = [](std::int64_t q16) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(
        q16, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()));
  };
  return {held(u_q16), held(v_q16)};
}

}  // namespace

// |du|, |dv| < 2^32: shifted by 2, their squares' sum fits 63 bits.
Way::Way(ImagePoint begin, ImagePoint end)
    : from(begin),
      du(std::int64_t{end.u_q16} - begin.u_q16),
      dv(std::int64_t{end.v_q16} - begin.v_q16),
      length(integer_root((du >> 2) * (du >> 2) + (dv >> 2) * (dv >> 2)) * 4) {}

ImagePoint Way::at(std::int64_t part, std::int64_t whole) const {
  return image_point(from.u_q16 + du * part / whole, from.v_q16 + dv * part / whole);
}

// The direction in 1/256 px: its products with lengths of 34 bits fit 64 bits.
ImagePoint Way::beside(std::int64_t along_q16, std::int64_t aside_q16) const {
  const std::int64_t u = du / 256;
  const std::int64_t v = dv / 256;
  const std::int64_t whole = length / 256;
  return image_point(from.u_q16 + (u * along_q16 - v * aside_q16) / whole,
                     from.v_q16 + (v * along_q16 + u * aside_q16) / whole);
}

void draw_arrow(Painter& painter, MarkScale scale, const Way& way, std::int32_t thickness_px,
                Rgb colour) {
  const std::int64_t head = std::int64_t{scale.px(kHeadLength)} << 16;
  const PixelPoint tip = nearest_pixel(way.at(1, 1));
  painter.line(nearest_pixel(way.from), tip, thickness_px, colour);
  // A shaft not longer than its head would point backwards.
  if (way.length < head) {
    return;
  }
  const std::int64_t half_width = std::int64_t{scale.px(kHeadHalfWidth)} << 16;
  for (const std::int64_t side : {-half_width, half_width}) {
    painter.line(nearest_pixel(way.beside(way.length - head, side)), tip, thickness_px, colour);
  }
}

}  // namespace tubesight::core::overlay
