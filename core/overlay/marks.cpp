#include "core/overlay/marks.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/overlay/arrow.h"
#include "core/overlay/font.h"
#include "core/overlay/labels.h"
#include "core/overlay/palette.h"
#include "core/overlay/text_line.h"

namespace tubesight::core::overlay {
namespace {

// Lengths in pixels of a picture 640 px in width. A halo keeps marks apart from a bright sheet.
constexpr std::int32_t kHalo = 1;
constexpr std::int32_t kTubeReach = 5;
constexpr std::int32_t kAxisThickness = 3;
// An offset whose arrow would be shorter has none.
constexpr std::int32_t kShortestOffset = 12;
constexpr std::int32_t kLetterAside = 7;
constexpr std::int32_t kRingRadius = 5;

// The frame stands this far outside of the rim; a rim that is not known has the middle one's size.
constexpr std::int32_t kFrameGap = 4;
constexpr std::int32_t kFrameThickness = 4;
constexpr std::int32_t kUnknownRim = 30;
constexpr std::int32_t kLargestRim_px = 1024;

constexpr std::int32_t kPinHeight = 14;
constexpr std::int32_t kPinHalfWidth = 7;
constexpr std::int32_t kClaimRadius = 15;

PixelBox box_around(PixelPoint at, std::int32_t reach_px) {
  return {at.u_px - reach_px, at.v_px - reach_px, at.u_px + reach_px, at.v_px + reach_px};
}

// A letter beside an axis, on the side that the other one does not leave to.
void draw_axis_letter(Painter& painter, MarkScale scale, const Way& way,
                      const std::optional<Way>& other, std::string_view letter, Rgb colour) {
  if (way.length < (std::int64_t{1} << 16)) {
    return;
  }
  // In 1/256 px: products of two of them fit 64 bits.
  const std::int64_t turn =
      other ? way.du / 256 * (other->dv / 256) - way.dv / 256 * (other->du / 256) : 0;
  const std::int64_t aside = std::int64_t{scale.px(kLetterAside) + 4 * scale.text()} << 16;
  const PixelPoint middle =
      nearest_pixel(way.beside(way.length / 4 * 3, turn > 0 ? -aside : aside));
  const std::int32_t top = middle.v_px - kCapitalHeight * scale.text() / 2;
  draw_label(painter, scale, label_box(middle.u_px, top, letter, scale), letter, colour);
}

}  // namespace

void draw_search_window(Painter& painter, MarkScale scale, const PixelBox& window) {
  painter.outline(window, scale.px(1), palette::kWindow);
}

void draw_optimum(Painter& painter, MarkScale scale, PixelPoint at) {
  const std::int32_t reach = scale.px(6);
  const std::int32_t thickness = scale.px(1);
  const PixelPoint top{at.u_px, at.v_px - reach};
  const PixelPoint bottom{at.u_px, at.v_px + reach};
  const PixelPoint left{at.u_px - reach, at.v_px};
  const PixelPoint right{at.u_px + reach, at.v_px};
  painter.line(top, right, thickness, palette::kWindow);
  painter.line(right, bottom, thickness, palette::kWindow);
  painter.line(bottom, left, thickness, palette::kWindow);
  painter.line(left, top, thickness, palette::kWindow);
}

void draw_estimates(Painter& painter, MarkScale scale, std::span<const Estimate> estimates) {
  const std::int32_t thin = scale.px(1);
  const std::int32_t halo = scale.px(kHalo);
  for (const Estimate& estimate : estimates) {
    const PixelPoint at = nearest_pixel(estimate.center_px);
    const Rgb colour = estimate_colour(estimate.state);
    switch (estimate.state) {
      case TubeState::kOpen:
        painter.fill(box_around(at, thin + halo), palette::kBlack);
        painter.fill(box_around(at, thin), colour);
        break;
      case TubeState::kPlugged:
        painter.outline(box_around(at, scale.px(3) + halo), thin + 2 * halo, palette::kBlack);
        painter.outline(box_around(at, scale.px(3)), thin, colour);
        break;
      case TubeState::kAbsent:
        painter.diagonal_cross(at, scale.px(3), thin + 2 * halo, palette::kBlack);
        painter.diagonal_cross(at, scale.px(3), thin, colour);
        break;
    }
  }
  draw_addresses(painter, scale, estimates);
}

void draw_tube(Painter& painter, MarkScale scale, const TubeSighting& tube) {
  const PixelPoint at = nearest_pixel(tube.center_px);
  const std::int32_t reach = scale.px(kTubeReach);
  const std::int32_t halo = scale.px(kHalo);
  if (tube.plug) {
    const std::int32_t thickness = scale.px(2);
    painter.outline(box_around(at, scale.px(7) + halo), thickness + 2 * halo, palette::kBlack);
    painter.outline(box_around(at, scale.px(7)), thickness, palette::kPlug);
  } else if (tube.quality_permyriad <= 0) {
    const std::int32_t thickness = scale.px(2);
    painter.diagonal_cross(at, reach, thickness + 2 * halo, palette::kBlack);
    painter.diagonal_cross(at, reach, thickness, palette::kRejected);
  } else {
    const std::int32_t thickness = scale.px(1);
    painter.cross_hair(at, 0, reach + halo, thickness + 2 * halo, palette::kBlack);
    painter.cross_hair(at, 0, reach, thickness, palette::kUsed);
  }
}

void draw_axis_point(Painter& painter, MarkScale scale, PixelPoint at) {
  const std::int32_t outer = scale.px(kRingRadius);
  const std::int32_t inner = outer - scale.px(1) + 1;
  const std::int32_t halo = scale.px(kHalo);
  painter.ring(at, std::max(0, inner - halo), outer + halo, palette::kBlack);
  painter.ring(at, inner, outer, palette::kAxis);
}

void draw_offset(Painter& painter, MarkScale scale, ImagePoint tube, ImagePoint axis) {
  const Way whole(tube, axis);
  const std::int64_t ring = std::int64_t{scale.px(kRingRadius + 2)} << 16;
  const std::int64_t shaft = whole.length - ring;
  if (shaft < (std::int64_t{scale.px(kShortestOffset)} << 16)) {
    return;
  }
  const Way way(tube, whole.at(shaft >> 8, whole.length >> 8));
  const std::int32_t thickness = scale.px(2);
  draw_arrow(painter, scale, way, thickness + 2 * scale.px(kHalo), palette::kBlack);
  draw_arrow(painter, scale, way, thickness, palette::kTool);
}

void draw_tool(Painter& painter, MarkScale scale, PixelPoint at, std::optional<HalfSize> rim,
               bool aligned) {
  const auto half = [&](std::int32_t known_px) {
    const std::int32_t size =
        rim ? std::clamp(known_px, scale.px(kRingRadius), kLargestRim_px) : scale.px(kUnknownRim);
    return size + scale.px(kFrameGap + kFrameThickness);
  };
  const std::int32_t half_u = half(rim ? rim->u_px : 0);
  const std::int32_t half_v = half(rim ? rim->v_px : 0);
  const std::int32_t thickness = scale.px(kFrameThickness);
  // Corners: two fifths of a side from each end, so that a fifth stays open.
  const std::int32_t side_u = half_u * 4 / 5;
  const std::int32_t side_v = half_v * 4 / 5;
  const auto [u, v] = at;
  for (const bool edge : {true, false}) {
    const std::int32_t out = edge ? scale.px(kHalo) : 0;
    const Rgb colour = edge ? palette::kBlack : palette::kTool;
    const PixelBox box{u - half_u - out, v - half_v - out, u + half_u + out, v + half_v + out};
    const std::int32_t thick = thickness + 2 * out;
    if (aligned) {
      painter.outline(box, thick, colour);
      continue;
    }
    const std::int32_t long_u = side_u + 2 * out - 1;
    const std::int32_t long_v = side_v + 2 * out - 1;
    for (const std::int32_t top : {box.top, box.bottom - thick + 1}) {
      painter.fill({box.left, top, box.left + long_u, top + thick - 1}, colour);
      painter.fill({box.right - long_u, top, box.right, top + thick - 1}, colour);
    }
    for (const std::int32_t left : {box.left, box.right - thick + 1}) {
      painter.fill({left, box.top, left + thick - 1, box.top + long_v}, colour);
      painter.fill({left, box.bottom - long_v, left + thick - 1, box.bottom}, colour);
    }
  }
}

void draw_axes(Painter& painter, MarkScale scale, ImagePoint origin,
               std::optional<ImagePoint> next_row, std::optional<ImagePoint> next_column) {
  struct Axis {
    std::optional<Way> way;
    std::string_view letter;
    Rgb colour;
  };
  const auto way = [&](const std::optional<ImagePoint>& next) {
    return next ? std::optional(Way(origin, *next)) : std::nullopt;
  };
  const std::array<Axis, 2> axes{Axis{way(next_row), "R", palette::kRow},
                                 Axis{way(next_column), "C", palette::kColumn}};
  const std::int32_t halo = scale.px(kHalo);
  const std::int32_t thickness = scale.px(kAxisThickness);
  const auto draw = [&](const Axis& axis, std::int32_t thick, Rgb colour) {
    if (axis.way) {
      draw_arrow(painter, scale, Way(axis.way->at(2, 5), axis.way->at(4, 5)), thick, colour);
    }
  };
  // Both halos lie under both axes: neither cuts the other.
  for (const Axis& axis : axes) {
    draw(axis, thickness + 2 * halo, palette::kBlack);
  }
  for (const Axis& axis : axes) {
    draw(axis, thickness, axis.colour);
  }
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    if (axes[i].way) {
      draw_axis_letter(painter, scale, *axes[i].way, axes[1 - i].way, axes[i].letter,
                       axes[i].colour);
    }
  }
  const PixelPoint center = nearest_pixel(origin);
  painter.fill(box_around(center, scale.px(2) + halo), palette::kBlack);
  painter.fill(box_around(center, scale.px(2)), palette::kWhite);
}

void draw_contradicted_claim(Painter& painter, MarkScale scale, PixelPoint at) {
  const std::int32_t outer = scale.px(kClaimRadius);
  const std::int32_t halo = scale.px(kHalo);
  const std::int32_t thickness = scale.px(3);
  // Seven tenths: the bar's ends lie on the ring.
  const std::int32_t reach = outer * 7 / 10;
  const PixelPoint begin{at.u_px - reach, at.v_px - reach};
  const PixelPoint end{at.u_px + reach, at.v_px + reach};
  painter.ring(at, std::max(0, outer - thickness + 1 - halo), outer + halo, palette::kBlack);
  painter.line(begin, end, thickness + 2 * halo, palette::kBlack);
  painter.ring(at, std::max(0, outer - thickness + 1), outer, palette::kClaim);
  painter.line(begin, end, thickness, palette::kClaim);
}

void draw_click(Painter& painter, MarkScale scale, const Click& click) {
  const PixelPoint tip = nearest_pixel(click.at_px);
  const Rgb colour =
      click.verdict == ClickVerdict::kTaken ? palette::kClick : palette::kClickRefused;
  const std::int32_t height = scale.px(kPinHeight);
  const std::int32_t half = scale.px(kPinHalfWidth);
  const PixelPoint left{tip.u_px - half, tip.v_px - height};
  const PixelPoint right{tip.u_px + half, tip.v_px - height};
  const std::int32_t thickness = scale.px(2);
  const auto pin = [&](std::int32_t thick, Rgb ink) {
    painter.line(tip, left, thick, ink);
    painter.line(tip, right, thick, ink);
    painter.line(left, right, thick, ink);
  };
  pin(thickness + 2 * scale.px(kHalo), palette::kBlack);
  pin(thickness, colour);
  if (click.verdict == ClickVerdict::kBlamed) {
    for (std::int32_t up = 0; up <= height; ++up) {
      const std::int32_t wide = half * up / height;
      painter.fill({tip.u_px - wide, tip.v_px - up, tip.u_px + wide, tip.v_px - up}, colour);
    }
  }
  const TextLine words = address_text(click.address);
  const std::int32_t top = left.v_px - (kCapitalHeight + 4) * scale.text() - thickness;
  draw_label(painter, scale, label_box(tip.u_px, top, words.view(), scale), words.view(), colour);
}

}  // namespace tubesight::core::overlay
