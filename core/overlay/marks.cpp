#include "core/overlay/marks.h"

#include <cstdlib>

#include "core/overlay/font.h"
#include "core/overlay/palette.h"
#include "core/overlay/readout.h"
#include "core/overlay/text_line.h"

namespace tubesight::core::overlay {
namespace {

// The tool's cross-hair is the largest mark: its arms begin inside a tube-end's dark (some 25 px in
// radius near the middle of a 635 px picture) and end well outside the rim.
constexpr std::int32_t kToolGap_px = 14;
constexpr std::int32_t kToolReach_px = 52;
constexpr std::int32_t kToolThickness_px = 5;
constexpr std::int32_t kToolBox_px = 8;
// Half of the bars across the arms' ends: they show beside an axis that lies on an arm.
constexpr std::int32_t kToolBar_px = 9;

constexpr std::int32_t kAxisThickness_px = 3;
constexpr std::int32_t kArrowLength_px = 11;
constexpr std::int32_t kArrowWidth_px = 5;

constexpr std::int32_t kTubeReach_px = 5;

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

PixelBox box_around(PixelPoint at, std::int32_t reach_px) {
  return {at.u_px - reach_px, at.v_px - reach_px, at.u_px + reach_px, at.v_px + reach_px};
}

struct Arrow {
  PixelPoint from;
  PixelPoint tip;
  PixelPoint barb_left;
  PixelPoint barb_right;
};

// The arrow from `origin` over four fifths of the way to `next`; works in 1/65536 px throughout.
Arrow arrow_towards(ImagePoint origin, ImagePoint next) {
  const std::int64_t du = std::int64_t{next.u_q16} - origin.u_q16;
  const std::int64_t dv = std::int64_t{next.v_q16} - origin.v_q16;
  const std::int64_t tip_u = origin.u_q16 + du * 4 / 5;
  const std::int64_t tip_v = origin.v_q16 + dv * 4 / 5;
  // |du|, |dv| < 2^32: shifted by 2, their squares' sum fits 63 bits.
  const std::int64_t length = integer_root((du >> 2) * (du >> 2) + (dv >> 2) * (dv >> 2)) * 4;
  const auto point = [](std::int64_t u_q16, std::int64_t v_q16) {
    return nearest_pixel({static_cast<std::int32_t>(u_q16), static_cast<std::int32_t>(v_q16)});
  };
  Arrow arrow{point(origin.u_q16, origin.v_q16), point(tip_u, tip_v), {}, {}};
  arrow.barb_left = arrow.tip;
  arrow.barb_right = arrow.tip;
  // A shaft not longer than its head would point backwards.
  if (length < (std::int64_t{2 * kArrowLength_px} << 16)) {
    return arrow;
  }
  const auto barb = [&](std::int64_t side) {
    // Pixels first: the product of two numbers in 1/65536 px could leave 64 bits.
    const std::int64_t back_u = (du * kArrowLength_px - side * dv * kArrowWidth_px) * 256 / length;
    const std::int64_t back_v = (dv * kArrowLength_px + side * du * kArrowWidth_px) * 256 / length;
    return PixelPoint{arrow.tip.u_px - static_cast<std::int32_t>(nearest_quotient(back_u, 256)),
                      arrow.tip.v_px - static_cast<std::int32_t>(nearest_quotient(back_v, 256))};
  };
  arrow.barb_left = barb(-1);
  arrow.barb_right = barb(1);
  return arrow;
}

void draw_arrow(Painter& painter, const Arrow& arrow, std::int32_t thickness_px, Rgb colour) {
  painter.line(arrow.from, arrow.tip, thickness_px, colour);
  painter.line(arrow.barb_left, arrow.tip, thickness_px, colour);
  painter.line(arrow.barb_right, arrow.tip, thickness_px, colour);
}

TextLine address_text(TubeAddress address) {
  TextLine line;
  line.integer(address.row).words(",").integer(address.column);
  return line;
}

// Where an estimate's address is written: centred beneath its dot.
PixelBox label_box(PixelPoint at, std::string_view words) {
  constexpr std::int32_t kBelow_px = 8;
  const std::int32_t left = at.u_px - text_width_px(words, 1) / 2;
  const std::int32_t top = at.v_px + kBelow_px;
  return {left, top, left + text_width_px(words, 1) - 1, top + kCapitalHeight + 1};
}

bool overlap(const PixelBox& a, const PixelBox& b) {
  return a.left <= b.right + 2 && b.left <= a.right + 2 && a.top <= b.bottom && b.top <= a.bottom;
}

// Whether the address of `estimates[index]` can be written in `box` without touching another
// estimate's dot or address. Of two addresses that touch none is written, so that the choice does
// not depend on the order.
bool has_room(std::span<const Estimate> estimates, std::size_t index, const PixelBox& box) {
  // The longest address is 23 characters of 6 px wide.
  constexpr std::int32_t kFar_px = 160;
  constexpr std::int32_t kBeneath_px = 24;
  const PixelPoint at = nearest_pixel(estimates[index].center_px);
  for (std::size_t other = 0; other < estimates.size(); ++other) {
    const PixelPoint place = nearest_pixel(estimates[other].center_px);
    if (other == index || std::abs(place.v_px - at.v_px) > kBeneath_px ||
        std::abs(place.u_px - at.u_px) > kFar_px) {
      continue;
    }
    const TextLine words = address_text(estimates[other].address);
    if (overlap(box, box_around(place, 3)) || overlap(box, label_box(place, words.view()))) {
      return false;
    }
  }
  return true;
}

void draw_address(Painter& painter, std::span<const Estimate> estimates, std::size_t index,
                  Rgb colour) {
  const TextLine words = address_text(estimates[index].address);
  const PixelBox box = label_box(nearest_pixel(estimates[index].center_px), words.view());
  const std::int32_t floor =
      painter.height_px() - readout_height_px(painter.width_px(), painter.height_px());
  if (box.left < 0 || box.top < 0 || box.right >= painter.width_px() || box.bottom >= floor ||
      !has_room(estimates, index, box)) {
    return;
  }
  painter.fill({box.left - 1, box.top - 1, box.right + 1, box.bottom}, palette::kBlack);
  painter.text({box.left, box.top}, words.view(), 1, colour);
}

}  // namespace

void draw_search_window(Painter& painter, const PixelBox& window) {
  painter.outline(window, 1, palette::kWindow);
}

void draw_optimum(Painter& painter, PixelPoint at) {
  constexpr std::int32_t kReach_px = 6;
  const PixelPoint top{at.u_px, at.v_px - kReach_px};
  const PixelPoint bottom{at.u_px, at.v_px + kReach_px};
  const PixelPoint left{at.u_px - kReach_px, at.v_px};
  const PixelPoint right{at.u_px + kReach_px, at.v_px};
  painter.line(top, right, 1, palette::kWindow);
  painter.line(right, bottom, 1, palette::kWindow);
  painter.line(bottom, left, 1, palette::kWindow);
  painter.line(left, top, 1, palette::kWindow);
}

void draw_estimates(Painter& painter, std::span<const Estimate> estimates) {
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const PixelPoint at = nearest_pixel(estimates[i].center_px);
    switch (estimates[i].state) {
      case TubeState::kOpen:
        painter.fill(box_around(at, 2), palette::kBlack);
        painter.fill(box_around(at, 1), palette::kEstimateOpen);
        draw_address(painter, estimates, i, palette::kEstimateOpen);
        break;
      case TubeState::kPlugged:
        painter.outline(box_around(at, 4), 3, palette::kBlack);
        painter.outline(box_around(at, 3), 1, palette::kEstimatePlugged);
        draw_address(painter, estimates, i, palette::kEstimatePlugged);
        break;
      case TubeState::kAbsent:
        painter.diagonal_cross(at, 3, 3, palette::kBlack);
        painter.diagonal_cross(at, 3, 1, palette::kEstimateAbsent);
        break;
    }
  }
}

void draw_tube(Painter& painter, const TubeSighting& tube) {
  const PixelPoint at = nearest_pixel(tube.center_px);
  if (tube.plug) {
    painter.outline(box_around(at, kTubeReach_px + 3), 4, palette::kBlack);
    painter.outline(box_around(at, kTubeReach_px + 2), 2, palette::kPlug);
  } else if (tube.quality_permyriad <= 0) {
    painter.diagonal_cross(at, kTubeReach_px, 4, palette::kBlack);
    painter.diagonal_cross(at, kTubeReach_px, 2, palette::kRejected);
  } else {
    painter.cross_hair(at, 0, kTubeReach_px + 1, 3, palette::kBlack);
    painter.cross_hair(at, 0, kTubeReach_px, 1, palette::kUsed);
  }
}

void draw_axis_point(Painter& painter, PixelPoint at) {
  constexpr std::int32_t kRadius_px = 5;
  painter.circle(at, kRadius_px - 1, palette::kBlack);
  painter.circle(at, kRadius_px + 1, palette::kBlack);
  painter.circle(at, kRadius_px, palette::kAxis);
}

void draw_tool(Painter& painter, PixelPoint at, bool aligned) {
  // Twice the same shape: once larger in black, as an edge that keeps it apart from a bright sheet.
  for (const std::int32_t edge : {1, 0}) {
    const Rgb colour = edge == 1 ? palette::kBlack : palette::kTool;
    painter.cross_hair(at, kToolGap_px - edge, kToolReach_px + edge, kToolThickness_px + 2 * edge,
                       colour);
    const std::int32_t near = kToolReach_px - 2 - edge;
    const std::int32_t far = kToolReach_px + edge;
    const std::int32_t half = kToolBar_px + edge;
    const auto [u, v] = at;
    painter.fill({u - far, v - half, u - near, v + half}, colour);
    painter.fill({u + near, v - half, u + far, v + half}, colour);
    painter.fill({u - half, v - far, u + half, v - near}, colour);
    painter.fill({u - half, v + near, u + half, v + far}, colour);
    if (aligned) {
      painter.fill(box_around(at, kToolBox_px + edge), colour);
    } else {
      painter.outline(box_around(at, kToolBox_px + edge), 2 + 2 * edge, colour);
    }
  }
}

void draw_axes(Painter& painter, ImagePoint origin, std::optional<ImagePoint> next_row,
               std::optional<ImagePoint> next_column) {
  // Both halos lie under both axes: neither axis is cut at the corner.
  if (next_row) {
    draw_arrow(painter, arrow_towards(origin, *next_row), kAxisThickness_px + 2, palette::kBlack);
  }
  if (next_column) {
    draw_arrow(painter, arrow_towards(origin, *next_column), kAxisThickness_px + 2,
               palette::kBlack);
  }
  if (next_row) {
    draw_arrow(painter, arrow_towards(origin, *next_row), kAxisThickness_px, palette::kRow);
  }
  if (next_column) {
    draw_arrow(painter, arrow_towards(origin, *next_column), kAxisThickness_px, palette::kColumn);
  }
  const PixelPoint corner = nearest_pixel(origin);
  painter.fill(box_around(corner, 3), palette::kBlack);
  painter.fill(box_around(corner, 2), palette::kWhite);
}

}  // namespace tubesight::core::overlay
