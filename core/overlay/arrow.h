#pragma once

#include <cstdint>

#include "core/base/sighting.h"
#include "core/overlay/mark_scale.h"
#include "core/overlay/painter.h"
#include "core/overlay/pixels.h"

namespace tubesight::core::overlay {

/// The straight way from one place of the picture to another, in 1/65536 px throughout.
struct Way {
  Way(ImagePoint begin, ImagePoint end);

  /// The place at `part` / `whole` of the way, held within 32 bits; 0 <= part, 0 < whole, both
  /// below 2^30.
  [[nodiscard]] ImagePoint at(std::int64_t part, std::int64_t whole) const;

  /// The place `along_q16` of the way from its beginning and `aside_q16` to the right of it as one
  /// looks along it; both below 2^34. The way must be longer than a pixel.
  [[nodiscard]] ImagePoint beside(std::int64_t along_q16, std::int64_t aside_q16) const;

  ImagePoint from;
  std::int64_t du;
  std::int64_t dv;
  std::int64_t length;
};

/// Draws an arrow over the whole way. Its head is 11 px long and 10 px wide in a picture 640 px in
/// width; a way shorter than that has none.
void draw_arrow(Painter& painter, MarkScale scale, const Way& way, std::int32_t thickness_px,
                Rgb colour);

}  // namespace tubesight::core::overlay
