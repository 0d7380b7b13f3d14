#include "core/overlay/overlay.h"

#include "core/base/assert.h"
#include "core/overlay/marks.h"
#include "core/overlay/painter.h"
#include "core/overlay/readout.h"

namespace tubesight::core::overlay {

void copy_grey(const ImageView& grey, const RgbImageView& picture) {
  TUBESIGHT_ASSERT(grey.width_px == picture.width_px && grey.height_px == picture.height_px);
  for (std::int32_t v = 0; v < grey.height_px; ++v) {
    const std::uint8_t* from = grey.line(v);
    std::uint8_t* to = picture.pixels + static_cast<std::ptrdiff_t>(v) * picture.stride_bytes;
    for (std::int32_t u = 0; u < grey.width_px; ++u) {
      to[0] = *from;
      to[1] = *from;
      to[2] = *from;
      to += 3;
      ++from;
    }
  }
}

void draw_overlay(const RgbImageView& picture, const OverlayInput& input) {
  Painter painter(picture);
  const Sighting& sighting = input.sighting;

  if (input.window) {
    draw_search_window(painter, *input.window);
  }
  if (input.optimum_px) {
    draw_optimum(painter, nearest_pixel(*input.optimum_px));
  }
  draw_estimates(painter, input.estimates);
  for (const TubeSighting& tube : input.tubes) {
    // The axes mark the primary tube, unless it is rejected or a plug, which must be seen.
    const bool primary = sighting.primary_known && tube.address == sighting.primary;
    if (!primary || tube.plug || tube.quality_permyriad <= 0) {
      draw_tube(painter, tube);
    }
  }
  if (sighting.axis_known) {
    draw_axis_point(painter, nearest_pixel(sighting.axis_px));
  }
  if (sighting.tool_known) {
    draw_tool(painter, nearest_pixel(sighting.tool_px), sighting.aligned);
  }
  if (sighting.primary_known) {
    draw_axes(painter, sighting.primary_px, input.next_row_px, input.next_column_px);
  }
  draw_readout(painter, sighting, input.field);
}

}  // namespace tubesight::core::overlay
