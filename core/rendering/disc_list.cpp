#include "core/rendering/disc_list.h"

#include <algorithm>
#include <cmath>

#include "core/rendering/disc_maker.h"

namespace tubesight::core::rendering {
namespace {

/// The addresses whose tube-ends may be seen, by the nodes that have light.
struct Range {
  std::int32_t first_row = 0, last_row = -1;
  std::int32_t first_column = 0, last_column = -1;
};

Range visible_addresses(const Scene& scene, const LightGrid& light) {
  const auto& sheet = scene.sheet;
  const double determinant = sheet.row_step_mm[0] * sheet.column_step_mm[1] -
                             sheet.row_step_mm[1] * sheet.column_step_mm[0];
  double low_row = 1e9, high_row = -1e9, low_column = 1e9, high_column = -1e9;
  for (std::int32_t node = 0; node < light.nodes(); ++node) {
    if (!light.lit(node)) {
      continue;
    }
    const std::array<double, 2> point = light.sheet_mm(node);
    const double x = point[0] - sheet.origin_mm[0];
    const double y = point[1] - sheet.origin_mm[1];
    const double row = (x * sheet.column_step_mm[1] - y * sheet.column_step_mm[0]) / determinant;
    const double column = (y * sheet.row_step_mm[0] - x * sheet.row_step_mm[1]) / determinant;
    low_row = std::min(low_row, row);
    high_row = std::max(high_row, row);
    low_column = std::min(low_column, column);
    high_column = std::max(high_column, column);
  }
  if (low_row > high_row) {
    return {};
  }
  const auto index = [](double value, double beyond, const std::array<std::int32_t, 2>& limits) {
    return static_cast<std::int32_t>(
        std::clamp(value + beyond, static_cast<double>(limits[0]), static_cast<double>(limits[1])));
  };
  // Rows of odd number stand further by the shift: their columns begin and end sooner by it.
  low_column -= std::max(sheet.odd_row_shift, 0.0);
  high_column -= std::min(sheet.odd_row_shift, 0.0);
  return {index(std::floor(low_row), -1.0, sheet.rows), index(std::ceil(high_row), 1.0, sheet.rows),
          index(std::floor(low_column), -1.0, sheet.columns),
          index(std::ceil(high_column), 1.0, sheet.columns)};
}

}  // namespace

void DiscList::fill(const Scene& scene, const TubeEnds& ends, const View& view,
                    const Exposure& exposure, const LightGrid& light, std::int32_t top,
                    std::int32_t bottom) {
  discs_.clear();
  tubes_.clear();
  active_.clear();
  top_ = top;
  bottom_ = bottom;
  entered_ = top;
  std::fill(begins_.begin(), begins_.end(), -1);
  const Range range = visible_addresses(scene, light);
  for (std::int32_t row = range.first_row; row <= range.last_row; ++row) {
    for (std::int32_t column = range.first_column; column <= range.last_column; ++column) {
      add_tube(scene, ends, view, exposure, light, {row, column});
    }
  }
}

void DiscList::add_tube(const Scene& scene, const TubeEnds& ends, const View& view,
                        const Exposure& exposure, const LightGrid& light, TubeAddress address) {
  const std::array<double, 2> at = ends.lattice_point(address);
  // Most of a range is not in the picture; that is found out before anything else.
  if (!DiscMaker::may_be_seen(scene, view, at, top_, bottom_) || tubes_.full()) {
    return;
  }
  const TubeEnd end = ends.at(address);
  if (end.kind == TubeEndKind::kVoid) {
    return;
  }
  Tube tube;
  tube.first = discs_.size();
  DiscMaker maker(scene, view, exposure, light, address, end);
  for (const Disc& disc : maker.discs()) {
    if (disc.bottom >= top_ && disc.top <= bottom_ && discs_.try_push_back(disc)) {
      tube.top = tube.count == 0 ? disc.top : std::min(tube.top, disc.top);
      tube.bottom = std::max(tube.bottom, disc.bottom);
      ++tube.count;
    }
  }
  if (tube.count == 0) {
    return;
  }
  const auto line = static_cast<std::size_t>(std::max(tube.top, top_));
  tube.next = begins_[line];
  begins_[line] = tubes_.size();
  static_cast<void>(tubes_.try_push_back(tube));  // there is room
}

void DiscList::draw(std::int32_t v, std::int32_t first, std::int32_t last, bool moves, Row& row) {
  for (; entered_ <= v; ++entered_) {
    for (std::int32_t tube = begins_[static_cast<std::size_t>(entered_)]; tube >= 0;
         tube = tubes_[tube].next) {
      static_cast<void>(active_.try_push_back(tube));  // as many as tubes
    }
  }
  std::int32_t kept = 0;
  for (std::int32_t i = 0; i < active_.size(); ++i) {
    const Tube& tube = tubes_[active_[i]];
    if (tube.bottom < v) {
      continue;
    }
    active_[kept] = active_[i];
    ++kept;
    for (std::int32_t k = 0; k < tube.count; ++k) {
      const Disc& disc = discs_[tube.first + k];
      if (v >= disc.top && v <= disc.bottom) {
        draw_disc(disc, v, first, last, moves, row);
      }
    }
  }
  active_.truncate(kept);
}

}  // namespace tubesight::core::rendering
