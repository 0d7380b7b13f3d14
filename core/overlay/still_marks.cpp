#include "core/overlay/still_marks.h"

#include "core/overlay/palette.h"

namespace tubesight::core::overlay {

Rgb colour_of(RimMark mark) {
  switch (mark) {
    case RimMark::kUsed: return palette::kUsed;
    case RimMark::kRejected: return palette::kRejected;
    case RimMark::kClosed: return palette::kPlug;
    case RimMark::kNotMeasured: break;
  }
  return palette::kEstimateAbsent;
}

void draw_rim_centre(Painter& painter, MarkScale scale, PixelPoint at, RimMark mark) {
  const std::int32_t reach = scale.px(3);
  const std::int32_t thickness = scale.px(1);
  const Rgb colour = colour_of(mark);
  const auto [u, v] = at;
  switch (mark) {
    case RimMark::kUsed: painter.cross_hair(at, 0, reach, thickness, colour); break;
    case RimMark::kRejected: painter.diagonal_cross(at, reach, thickness, colour); break;
    case RimMark::kClosed:
      painter.outline({u - reach, v - reach, u + reach, v + reach}, thickness, colour);
      break;
    case RimMark::kNotMeasured:
      painter.fill({u - thickness, v - thickness, u + thickness, v + thickness}, colour);
      break;
  }
}

void draw_rim_stretch(Painter& painter, MarkScale scale, PixelPoint from, PixelPoint to,
                      RimMark mark) {
  painter.line(from, to, scale.px(1), colour_of(mark));
}

void draw_edge_point(Painter& painter, MarkScale scale, PixelPoint at) {
  const std::int32_t reach = scale.px(1) / 2;
  painter.fill({at.u_px - reach, at.v_px - reach, at.u_px + reach, at.v_px + reach},
               palette::kWhite);
}

}  // namespace tubesight::core::overlay
