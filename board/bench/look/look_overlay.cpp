#include "board/bench/look/look_overlay.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "core/overlay/font.h"
#include "core/overlay/mark_scale.h"
#include "core/overlay/overlay.h"
#include "core/overlay/painter.h"
#include "core/overlay/palette.h"
#include "core/overlay/still_marks.h"

namespace tubesight::board {
namespace {

using core::detection::FoundLattice;
using core::detection::LatticeElement;
using core::overlay::MarkScale;
using core::overlay::Painter;
using core::overlay::PixelPoint;
using core::overlay::RimMark;
namespace palette = core::overlay::palette;

PixelPoint nearest(const Eigen::Vector2d& at) {
  return {static_cast<std::int32_t>(std::floor(at.x() + 0.5)),
          static_cast<std::int32_t>(std::floor(at.y() + 0.5))};
}

void draw_ellipse(Painter& painter, MarkScale scale, const LatticeElement& element) {
  constexpr int kCorners = 90;
  const Eigen::Matrix2d root = core::detection::root_of(element.ellipse.shape_px2);
  PixelPoint before;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const PixelPoint here = nearest(element.ellipse.center_px +
                                    root * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    if (i > 0) {
      core::overlay::draw_rim_stretch(painter, scale, before, here,
                                      element.share > 0.0 ? RimMark::kUsed : RimMark::kRejected);
    }
    before = here;
  }
}

/// Joins to the next element of the row and of the column; elements are in their order.
void draw_joins(Painter& painter, MarkScale scale, const FoundLattice& found) {
  for (std::int32_t i = 0; i < found.elements.size(); ++i) {
    const LatticeElement& here = found.elements[i];
    for (std::int32_t k = i + 1; k < found.elements.size(); ++k) {
      const LatticeElement& next = found.elements[k];
      if (next.row > here.row + 1) {
        break;
      }
      if (next.row == here.row && next.column == here.column + 1) {
        painter.line(nearest(here.center_px), nearest(next.center_px), scale.px(1), palette::kRow);
      } else if (next.row == here.row + 1 && next.column == here.column) {
        painter.line(nearest(here.center_px), nearest(next.center_px), scale.px(1),
                     palette::kColumn);
      }
    }
  }
}

void draw_address(Painter& painter, MarkScale scale, const LatticeElement& element) {
  const std::string words = std::to_string(element.row) + ',' + std::to_string(element.column);
  const std::int32_t width = core::overlay::text_width_px(words, scale.text());
  const PixelPoint center = nearest(element.center_px);
  // Within the element and beside its centre's cross.
  if (width < std::sqrt(element.ellipse.shape_px2(0, 0)) * 1.8 &&
      std::sqrt(element.ellipse.shape_px2(1, 1)) >
          core::overlay::kGlyphHeight * scale.text() + scale.px(4)) {
    painter.text({center.u_px - width / 2, center.v_px + scale.px(4)}, words, scale.text(),
                 palette::kWhite);
  }
}

}  // namespace

core::RgbImageView draw_lattice(const core::ImageView& picture, const FoundLattice& found,
                                std::vector<std::uint8_t>& pixels) {
  pixels.assign(std::size_t{3} * static_cast<std::size_t>(picture.width_px) *
                    static_cast<std::size_t>(picture.height_px),
                0);
  const core::RgbImageView view{pixels.data(), picture.width_px, picture.height_px,
                                3 * picture.width_px};
  core::overlay::copy_grey(picture, view);
  Painter painter(view);
  const MarkScale scale(picture.width_px);
  draw_joins(painter, scale, found);
  for (const LatticeElement& element : found.elements) {
    draw_ellipse(painter, scale, element);
    painter.cross_hair(nearest(element.center_px), 0, scale.px(2), scale.px(1), palette::kWhite);
    draw_address(painter, scale, element);
  }
  return view;
}

}  // namespace tubesight::board
