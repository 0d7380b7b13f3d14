#include "core/overlay/overlay.h"

#include "core/base/assert.h"
#include "core/overlay/mark_scale.h"
#include "core/overlay/marks.h"
#include "core/overlay/painter.h"
#include "core/overlay/readout.h"

namespace tubesight::core::overlay {
namespace {

void draw_marks(const RgbImageView& camera, const OverlayInput& input) {
  Painter painter(camera);
  const MarkScale scale(camera.width_px);
  const Sighting& sighting = input.sighting;

  if (input.window) {
    draw_search_window(painter, scale, *input.window);
  }
  if (input.optimum_px) {
    draw_optimum(painter, scale, nearest_pixel(*input.optimum_px));
  }
  draw_estimates(painter, scale, input.estimates);
  for (const TubeSighting& tube : input.tubes) {
    // The axes mark the primary tube, unless it is rejected or a plug, which must be seen.
    const bool primary = sighting.primary_known && tube.address == sighting.primary;
    if (!primary || tube.plug || tube.quality_permyriad <= 0) {
      draw_tube(painter, scale, tube);
    }
  }
  if (sighting.tool_known) {
    draw_tool(painter, scale, nearest_pixel(sighting.tool_px), input.tool_rim, sighting.aligned);
  }
  if (sighting.tool_known && sighting.axis_known) {
    draw_offset(painter, scale, sighting.tool_px, sighting.axis_px);
  }
  if (sighting.primary_known) {
    draw_axes(painter, scale, sighting.primary_px, input.next_row_px, input.next_column_px);
  }
  if (sighting.axis_known) {
    draw_axis_point(painter, scale, nearest_pixel(sighting.axis_px));
  }
  if (input.news.claimed_px) {
    draw_contradicted_claim(painter, scale, nearest_pixel(*input.news.claimed_px));
  }
  for (const Click& click : input.news.clicks) {
    draw_click(painter, scale, click);
  }
}

}  // namespace

std::int32_t overlay_height_px(std::int32_t width_px, std::int32_t height_px) {
  return height_px + readout_height_px(width_px);
}

void copy_grey(const ImageView& grey, const RgbImageView& picture) {
  TUBESIGHT_ASSERT(grey.width_px == picture.width_px && grey.height_px <= picture.height_px);
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
  const std::int32_t readout_px = readout_height_px(picture.width_px);
  TUBESIGHT_ASSERT(picture.height_px > readout_px);
  RgbImageView camera = picture;
  camera.height_px -= readout_px;
  draw_marks(camera, input);
  if (readout_px > 0) {
    RgbImageView below = picture;
    below.height_px = readout_px;
    below.pixels += static_cast<std::ptrdiff_t>(camera.height_px) * picture.stride_bytes;
    Painter painter(below);
    draw_readout(painter, input);
  }
}

}  // namespace tubesight::core::overlay
