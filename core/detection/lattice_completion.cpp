// What LatticeFinder does once a lattice is there: it measures again what is doubtful, and looks
// for the elements that its own let expect.
#include <algorithm>
#include <array>
#include <cstdint>

#include "core/detection/expected_element.h"
#include "core/detection/lattice_finder.h"

namespace tubesight::core::detection {
namespace {

// Of so little of an edge a shadow's may be a part: then it has to stand as kUnsure says.
constexpr double kPartOfEdge = 0.5;
// So must one with less contrast than this, grey levels.
constexpr double kGoodContrast = 8.0;

// One that a spot shows is measured again where its strangeness is above this.
constexpr double kDoubtful = 0.85;

// Nothing smaller is looked for where no spot was found.
constexpr double kLeastLookedFor_px = 2.0;

}  // namespace

/// Measures again, from where the neighbours expect it, what is less like them than it should be:
/// the spot was joined to a shadow beside it, and the edge followed.
void LatticeFinder::measure_doubtful(const picture::AveragedPicture& stretched,
                                     FoundLattice& found) {
  for (LatticeElement& element : found.elements) {
    LocalMap map;
    if (!map.fit(around(found, element.row, element.column, false), lens_)) {
      continue;
    }
    const double strange = strangeness(map, element.ellipse, found.steps, kStranger);
    LatticeElement again = element;
    again.ellipse = map.element(found.steps);
    again.levels.black = black_around(found, element.row, element.column);
    const bool doubtful = strange > kDoubtful || element.share == 0.0 ||
                          (element.share < kPartOfEdge &&
                           strangeness(map, element.ellipse, found.steps, kUnsure) > 1.0);
    if (!doubtful || half_axes(again.ellipse).y() < kLeastMeasured_px) {
      continue;
    }
    const Ellipse expected = again.ellipse;
    bool seen = look_for_edge(stretched, found.steps, element_, again) &&
                strangeness(map, again.ellipse, found.steps,
                            again.share > kPartOfEdge ? kNewcomer : kUnsure) <= 1.0;
    if (!seen && element.share < kPartOfEdge) {
      again.ellipse = expected;
      seen = look_for_contrast(stretched, again);
    }
    if (seen) {
      again.center_px = map.center_of(again.ellipse);
      element = again;
    }
  }
}

/// Leaves out what has no edge and is not quite where its neighbours expect it: the dark of a
/// weld's shadow reaches beyond the tube-end.
void LatticeFinder::drop_unsure(FoundLattice& found) {
  std::int32_t kept = 0;
  for (std::int32_t i = 0; i < found.elements.size(); ++i) {
    const LatticeElement& element = found.elements[i];
    LocalMap map;
    const bool unsure = element.share == 0.0 &&
                        half_axes(element.ellipse).y() >= kLeastMeasured_px &&
                        map.fit(around(found, element.row, element.column, false), lens_) &&
                        strangeness(map, element.ellipse, found.steps, kUnsure) > 1.0;
    if (!unsure) {
      found.elements[kept++] = element;
    }
  }
  found.elements.truncate(kept);
  fill_table(found);
}

/// The darkest inside of the elements around a place: its own is no brighter by much.
double LatticeFinder::black_around(const FoundLattice& found, std::int32_t row,
                                   std::int32_t column) const {
  double black = 255.0;
  for (std::int32_t i = 0; i < 25; ++i) {
    const std::int16_t k = entry(row + i / 5 - 2, column + i % 5 - 2);
    if (k >= 0 && i != 12) {
      black = std::min(black, found.elements[k].levels.black);
    }
  }
  return black < 255.0 ? black : 0.0;
}

/// Looks for elements beside those that there are, as long as there are more; then over a lane.
void LatticeFinder::complete(const picture::AveragedPicture& stretched, FoundLattice& found) {
  constexpr std::int32_t kLane = 2;
  std::int32_t beside = 0;  // elements around which all was looked for
  std::int32_t across = 0;
  // The list grows while it is walked: what was found now is looked around from, too.
  while (beside < found.elements.size() || across < found.elements.size()) {
    if (beside < found.elements.size()) {
      look_beside(stretched, beside++, 1, found);
    } else {
      look_beside(stretched, across++, kLane, found);
    }
  }
}

/// Looks for the elements so many steps from one to all sides.
void LatticeFinder::look_beside(const picture::AveragedPicture& stretched, std::int32_t from,
                                std::int32_t steps, FoundLattice& found) {
  constexpr std::array<std::array<std::int32_t, 2>, 8> kSides = {
      {{0, 1}, {0, -1}, {1, 0}, {-1, 0}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
  for (const auto& side : kSides) {
    const std::int32_t row = found.elements[from].row + steps * side[0];
    const std::int32_t column = found.elements[from].column + steps * side[1];
    if (in_table(row, column) && entry(row, column) == -1 && !found.elements.full() &&
        !try_place(stretched, from, row, column, found)) {
      entry(row, column) = -2;  // not again
    }
  }
}

/// Looks for an element where its neighbours, `from` among them, let expect it.
bool LatticeFinder::try_place(const picture::AveragedPicture& stretched, std::int32_t from,
                              std::int32_t row, std::int32_t column, FoundLattice& found) {
  LocalMap map;
  if (!map.fit(around(found, row, column, false), lens_)) {
    return false;
  }
  const Ellipse expected = map.element(found.steps);
  const Eigen::Vector2d place = map.to_pixel(Eigen::Vector2d::Zero());
  if (!(half_axes(expected).y() > kLeastLookedFor_px) || place.x() < 0.0 || place.y() < 0.0 ||
      place.x() > stretched.width_px - 1.0 || place.y() > stretched.height_px - 1.0) {
    return false;
  }
  LatticeElement element;
  element.row = row;
  element.column = column;
  element.ellipse = expected;
  element.levels.black = black_around(found, row, column);
  const bool small = half_axes(expected).y() < kLeastMeasured_px;
  const double black = element.levels.black;
  const bool seen = small ? look_for_spot(stretched, found.elements[from].ellipse, found.steps,
                                          least_contrast_, element)
                          : look_for_edge(stretched, found.steps, element_, element);
  const Levels there = measure_levels(stretched, expected);
  const bool sure = element.share > kPartOfEdge && there.around - there.black > kGoodContrast;
  const Likeness& like = small || sure ? kNewcomer : kUnsure;
  if (!(seen && strangeness(map, element.ellipse, found.steps, like) <= 1.0)) {
    element.ellipse = expected;
    if (small || (!look_for_contrast(stretched, element) &&
                  !look_for_blob(stretched, map, found, element))) {
      return false;
    }
  }
  element.center_px = map.center_of(element.ellipse);
  element.levels = measure_levels(stretched, element.ellipse);
  if (!small && is_closed(element, black)) {
    return false;
  }
  entry(row, column) = static_cast<std::int16_t>(found.elements.size());
  return found.elements.try_push_back(element);
}

/// The same by a spot that was found near there and not ordered: far out, what the neighbours let
/// expect is too far off for an edge.
bool LatticeFinder::look_for_blob(const picture::AveragedPicture& stretched, const LocalMap& map,
                                  const FoundLattice& found, LatticeElement& element) {
  for (const Blob& blob : blobs_) {
    if (blob.dark != found.dark ||
        !(strangeness(map, blob.ellipse, found.steps, kStranger) <= 1.0)) {
      continue;
    }
    element.ellipse = blob.ellipse;
    if (measure_spot(stretched, found.steps, element_, element) &&
        strangeness(map, element.ellipse, found.steps, kStranger) <= 1.0) {
      return true;
    }
  }
  return false;
}

}  // namespace tubesight::core::detection
