#include "core/overlay/dial.h"

#include <algorithm>

#include "core/overlay/arrow.h"
#include "core/overlay/mark_scale.h"
#include "core/overlay/palette.h"

namespace tubesight::core::overlay {
namespace {

// The head of the arrow is a fifth of the radius: that of a picture as wide as so many of them.
constexpr std::int32_t kArrow_px = 14;

}  // namespace

void draw_dial(Painter& painter, PixelPoint center, std::int32_t radius_px, std::int32_t line_px,
               const OverlayInput& input) {
  const Sighting& sighting = input.sighting;
  const std::int32_t ring_px = radius_px * 7 / 10;
  const bool known = sighting.tool_known && sighting.axis_known;
  const bool aligned = known && sighting.aligned;
  Rgb colour = palette::kUnknown;
  if (known) {
    colour = aligned ? palette::kStateTracking : palette::kStateDegraded;
  }
  // Aligned is a thicker ring, too.
  const std::int32_t thickness = line_px * (aligned ? 2 : 1);
  painter.ring(center, ring_px - thickness + 1, ring_px, colour);
  if (!known || input.aligned_within_um_q8 <= 0) {
    return;
  }
  const std::int32_t dot = line_px;
  painter.fill({center.u_px - dot, center.v_px - dot, center.u_px + dot, center.v_px + dot},
               palette::kTool);
  const Way seen(sighting.tool_px, sighting.axis_px);
  const std::int64_t length =
      std::min(std::int64_t{sighting.offset_um_q8} * (std::int64_t{ring_px} << 16) /
                   input.aligned_within_um_q8,
               std::int64_t{radius_px} << 16);
  // A hundredth of a pixel still has a direction.
  if (seen.length < 256 || length <= 0) {
    return;
  }
  const ImagePoint middle{center.u_px * 65'536, center.v_px * 65'536};
  // |du|, |dv| < 2^32 and length < 2^28: the products fit.
  const Way way(middle, {middle.u_q16 + static_cast<std::int32_t>(seen.du * length / seen.length),
                         middle.v_q16 + static_cast<std::int32_t>(seen.dv * length / seen.length)});
  draw_arrow(painter, MarkScale(kArrow_px * radius_px), way, 2 * line_px, palette::kTool);
}

}  // namespace tubesight::core::overlay
