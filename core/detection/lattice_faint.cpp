// What LatticeFinder does about tube-ends that are hardly seen: it judges them by their light.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include <Eigen/LU>

#include "core/detection/expected_element.h"
#include "core/detection/faint_element.h"
#include "core/detection/lattice_finder.h"

namespace tubesight::core::detection {
namespace {

// A weld's shadow, which joins the dark inside beside it, is brighter than these shares of the
// light.
constexpr std::array kDarkShares = {0.2, 0.1};

// Of an outline of which less was found, what is around says better where it is, and whether.
constexpr double kSureShare = 0.65;
constexpr double kWholeEdge = 0.75;
constexpr double kPartOfEdge = 0.5;

// Nothing with a shorter half axis is judged by its light.
constexpr double kLeastHalf_px = 6.0;

/// What the place of an element is worth in a map, by the scatter measured in the campaign's frames
/// (0.15 px of whole edges, 0.4 px and 0.9 px of parts): the edge of a part is drawn to where the
/// light on the wall ends.
double weight_of(const LatticeElement& element) {
  if (element.by_contrast) {
    return 0.1;
  }
  if (element.share == 0.0) {
    return 0.5;  // too small for an edge
  }
  return element.share > kWholeEdge ? 1.0 : element.share > kSureShare ? 0.4 : 0.1;
}

/// Whether a spot was found and no edge of it, or nothing yet.
bool is_edgeless(const LatticeElement& element) {
  return element.share == 0.0 && !element.by_contrast;
}

bool is_other(Verdict verdict) { return verdict == Verdict::kPlug || verdict == Verdict::kNone; }

std::int32_t whole_edges(const FoundLattice& found) {
  return static_cast<std::int32_t>(
      std::count_if(found.elements.begin(), found.elements.end(),
                    [](const LatticeElement& element) { return element.share > kWholeEdge; }));
}

/// Turns the lattice's own plane, in radii, into pixels.
Eigen::Matrix2d radius_of(const LocalMap& map, const Steps& steps) {
  Eigen::Matrix2d basis;
  basis << steps.column, steps.row;
  return map.slope() * basis.inverse();
}

}  // namespace

/// Pixels that the spots of a lattice cover.
double LatticeFinder::area_of(const Growth& growth) const {
  double area = 0.0;
  for (const Place& place : growth.places) {
    area += std::sqrt(blobs_[place.blob].ellipse.shape_px2.determinant());
  }
  return area;
}

/// Whether so few edges are whole that what was followed may be the edge of something else.
bool LatticeFinder::has_few_edges(const FoundLattice& found) {
  constexpr double kFew = 0.3;
  return whole_edges(found) < kFew * found.elements.size();
}

/// Looks for the lattice again where little is as dark as its elements; takes it if more of their
/// edges are whole.
bool LatticeFinder::look_darker(const picture::AveragedPicture& stretched,
                                const FinderOptions& options, FoundLattice& found) {
  if (find_blobs(stretched, options, kDarkShares) != FinderRefusal::kNone) {
    return false;
  }
  growth_.grow(blobs_, true, grown_[0]);
  darker_.dark = true;
  darker_.elements.clear();
  take_places(grown_[0], darker_);
  measure_all(stretched, darker_);
  if (whole_edges(darker_) <= whole_edges(found)) {
    return false;
  }
  found = darker_;
  return true;
}

/// Leaves out what little of an edge was found at where the light is that of a plug.
void LatticeFinder::drop_closed(const picture::AveragedPicture& stretched, FoundLattice& found) {
  std::int32_t kept = 0;
  for (std::int32_t i = 0; i < found.elements.size(); ++i) {
    const LatticeElement& element = found.elements[i];
    const bool weak = (element.by_contrast || element.share < kPartOfEdge) &&
                      half_axes(element.ellipse).y() >= kLeastMeasured_px;
    if (!weak || !is_none(look_at_faint(stretched, element.ellipse))) {
      found.elements[kept++] = element;
    }
  }
  found.elements.truncate(kept);
  fill_table(found);
}

/// The map of what is around, the more of it the clearer it is seen: what is hardly seen does not
/// bend it unless there is little else.
bool LatticeFinder::fit_weighed(const FoundLattice& found, std::int32_t row, std::int32_t column,
                                LocalMap& map) const {
  constexpr std::int32_t kLeastRings = 2;
  constexpr std::int32_t kMostRings = 12;
  constexpr double kEnough = 10.0;
  MapPoints points;
  double sum = 0.0;
  for (std::int32_t ring = 1; ring <= kMostRings && (sum < kEnough || ring <= kLeastRings);
       ++ring) {
    for (std::int32_t down = -ring; down <= ring; ++down) {
      const std::int32_t step = std::abs(down) == ring ? 1 : 2 * ring;
      for (std::int32_t right = -ring; right <= ring; right += step) {
        const std::int16_t i = entry(row + down, column + right);
        if (i >= 0) {
          const double weight = weight_of(found.elements[i]);
          static_cast<void>(
              points.try_push_back({{right, down}, found.elements[i].center_px, weight}));
          sum += weight;
        }
      }
    }
  }
  return map.fit(points, lens_);
}

/// Judges by their looks those of which little of an edge was found: leaves out what does not look
/// as a tube-end does there, and moves the others to where they look most as one.
void LatticeFinder::settle(const picture::AveragedPicture& stretched, FoundLattice& found) {
  // All are judged before one goes: the table counts in the list as it is.
  std::array<bool, kMaxElements> unlike{};
  for (std::int32_t i = 0; i < found.elements.size(); ++i) {
    LatticeElement& element = found.elements[i];
    LocalMap map;
    if ((!element.by_contrast && element.share >= kSureShare) ||
        half_axes(element.ellipse).y() < kLeastHalf_px ||
        !fit_weighed(found, element.row, element.column, map)) {
      continue;
    }
    LatticeElement there = element;
    there.ellipse = map.element(found.steps);
    Resemblance whole;
    const Verdict verdict = look_at(stretched, map, found, there, whole);
    if (verdict == Verdict::kUnsure && is_edgeless(element)) {
      unlike[static_cast<std::size_t>(i)] = true;  // the place is looked at again later
    } else if (is_other(verdict)) {
      // A tube-end may stand beside the place expected.
      LatticeElement own = element;
      unlike[static_cast<std::size_t>(i)] = (verdict == Verdict::kPlug && is_edgeless(element)) ||
                                            is_other(look_at(stretched, map, found, own, whole));
    } else if (verdict == Verdict::kAlike) {
      constexpr double kAsGood = 0.02;
      constexpr double kAgree_px = 1.5;
      const Sitting as_found = sitting_of(element.ellipse, radius_of(map, found.steps));
      const double off_px = (there.ellipse.center_px - element.ellipse.center_px).norm();
      if (off_px > kAgree_px &&
          whole.alike >= gallery_.compare(stretched, as_found, 0.0).alike - kAsGood) {
        there.center_px = map.center_of(there.ellipse);
        there.by_contrast = true;
        there.faint = true;
        element = there;
      }
    }
  }
  std::int32_t kept = 0;
  for (std::int32_t i = 0; i < found.elements.size(); ++i) {
    if (!unlike[static_cast<std::size_t>(i)]) {
      found.elements[kept++] = found.elements[i];
    }
  }
  found.elements.truncate(kept);
  fill_table(found);
}

/// Adds what shows no whole edge beside what was found, and then beyond what is not there: where
/// that lets expect it, if its light is that of an open tube-end.
void LatticeFinder::add_faint(const picture::AveragedPicture& stretched, FoundLattice& found) {
  constexpr std::int32_t kFar = 3;
  std::int32_t beside = 0;  // elements around which all was looked for
  std::int32_t beyond = 0;
  // The list grows while it is walked: what was added is a neighbour of the next.
  while (beside < found.elements.size() || beyond < found.elements.size()) {
    if (beside < found.elements.size()) {
      add_faint_around(stretched, beside++, 1, found);
    } else {
      add_faint_around(stretched, beyond++, kFar, found);
    }
  }
}

/// The same up to so many steps from one.
void LatticeFinder::add_faint_around(const picture::AveragedPicture& stretched, std::int32_t from,
                                     std::int32_t reach, FoundLattice& found) {
  for (std::int32_t down = -reach; down <= reach; ++down) {
    for (std::int32_t right = -reach; right <= reach && !found.elements.full(); ++right) {
      LatticeElement element;
      element.row = found.elements[from].row + down;
      element.column = found.elements[from].column + right;
      if (in_table(element.row, element.column) && entry(element.row, element.column) < 0 &&
          look_for_faint(stretched, found, element)) {
        entry(element.row, element.column) = static_cast<std::int16_t>(found.elements.size());
        static_cast<void>(found.elements.try_push_back(element));
      }
    }
  }
}

/// Looks whether there is a tube-end where its neighbours let expect it; again when it has got
/// more of them.
bool LatticeFinder::look_for_faint(const picture::AveragedPicture& stretched,
                                   const FoundLattice& found, LatticeElement& element) {
  constexpr std::int32_t kLooked = -10;  // in the table, less the neighbours there were
  std::int32_t looked = kLooked;
  for (std::int32_t k = 0; k < 9; ++k) {
    const std::int16_t i =
        std::as_const(*this).entry(element.row + k / 3 - 1, element.column + k % 3 - 1);
    looked -= i >= 0 ? 1 : 0;
  }
  std::int16_t& before = entry(element.row, element.column);
  LocalMap map;
  if (before <= looked || !fit_weighed(found, element.row, element.column, map)) {
    return false;
  }
  before = static_cast<std::int16_t>(looked);
  const Ellipse expected = map.element(found.steps);
  const Eigen::Vector2d& at = expected.center_px;
  const double half = half_axes(expected).y();
  if (!(half >= kLeastHalf_px && at.minCoeff() >= 0.0 && at.x() <= stretched.width_px - 1.0 &&
        at.y() <= stretched.height_px - 1.0)) {
    return false;
  }
  element.ellipse = expected;
  Resemblance whole;
  const Verdict verdict = look_at(stretched, map, found, element, whole);
  if (verdict != Verdict::kAlike && verdict != Verdict::kHidden) {
    element.ellipse = expected;
    if (half < kLeastMeasured_px) {
      return false;
    }
    const FaintLook look = look_at_faint(stretched, expected);
    const bool open = is_open(look) && !is_other(verdict);
    if (!open && !(may_be_beside(look) && look_beside_place(stretched, map, found, element))) {
      return false;
    }
  }
  element.center_px = map.center_of(element.ellipse);
  element.by_contrast = true;
  element.faint = true;
  return true;
}

/// Whether a place looks as the nearest tube-ends do; moves the element to where it does most.
Verdict LatticeFinder::look_at(const picture::AveragedPicture& stretched, const LocalMap& map,
                               const FoundLattice& found, LatticeElement& element,
                               Resemblance& whole) {
  constexpr std::int32_t kReach = 4;
  struct Near {
    double distance = 0.0;
    std::int16_t index = 0;
  };
  StaticVector<Near, (2 * kReach + 1) * (2 * kReach + 1)> near;
  for (std::int32_t down = -kReach; down <= kReach; ++down) {
    for (std::int32_t right = -kReach; right <= kReach; ++right) {
      const std::int16_t i = std::as_const(*this).entry(element.row + down, element.column + right);
      if (i >= 0 && (down != 0 || right != 0)) {
        const double distance = (right * found.steps.column + down * found.steps.row).norm();
        static_cast<void>(near.try_push_back({distance, i}));
      }
    }
  }
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.index < b.index;
  });
  const Eigen::Matrix2d radius_px = radius_of(map, found.steps);
  StaticVector<Sitting, PortraitGallery::kMost> sitters;
  for (const Near& one : near) {
    static_cast<void>(
        sitters.try_push_back(sitting_of(found.elements[one.index].ellipse, radius_px)));
  }
  if (!gallery_.hang(stretched, sitters)) {
    return Verdict::kUnsure;
  }
  const double half_px = half_axes(element.ellipse).y();
  const Sitting place = {element.ellipse.center_px, radius_px};
  whole = gallery_.compare(stretched, place, std::max(3.0, 0.15 * half_px));
  const HalfResemblance half = gallery_.compare_halves(stretched, place);
  const Verdict verdict = judge(whole, half, half_px, is_edgeless(element));
  if (verdict == Verdict::kAlike) {
    element.ellipse.center_px += whole.shift_px;
  }
  return verdict;
}

/// The same where the edge is clear but farther off than it was looked for: where the contrast
/// along the outline is highest.
bool LatticeFinder::look_beside_place(const picture::AveragedPicture& stretched,
                                      const LocalMap& map, const FoundLattice& found,
                                      LatticeElement& element) {
  const double black = black_around(found, element.row, element.column);
  element.ellipse = move_to_contrast(stretched, element.ellipse);
  element.levels.black = black;
  if (!is_open(look_at_faint(stretched, element.ellipse)) ||
      !look_for_edge(stretched, found.steps, element_, element) || element.share < kPartOfEdge ||
      !(strangeness(map, element.ellipse, found.steps, kNewcomer) <= 1.0)) {
    return false;
  }
  element.levels = measure_levels(stretched, element.ellipse);
  return !is_closed(element, black);
}

}  // namespace tubesight::core::detection
