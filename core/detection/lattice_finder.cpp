#include "core/detection/lattice_finder.h"

#include <algorithm>
#include <cmath>

#include "core/base/assert.h"
#include "core/detection/expected_element.h"
#include "core/detection/spot_weight.h"

namespace tubesight::core::detection {
namespace {

// A bright rim beside a dim sheet wants a low threshold, a dim gap between bright rims a high one.
constexpr std::array kShares = {0.5, 0.25};

// An element stands where its neighbours say, to these shares of the shorter step: one that a spot
// shows, and one that was looked for. The next element is a whole step off.
constexpr double kStranger = 0.3;
constexpr double kNewcomer = 0.15;
// One that a spot shows is measured again where its strangeness is above this.
constexpr double kDoubtful = 0.85;

// An edge measured around a spot has the spot's own form to this.
constexpr double kLeastOfSpot = 0.85;
constexpr double kMostOfSpot = 1.2;

// Below this half axis an edge is mostly blur, and the spot is weighed.
constexpr double kLeastMeasured_px = 6.5;
// Above this one the light across it is uneven, and its pixels say it better.
constexpr double kMostWeighed_px = 10.0;

// One that stands out less than this share of its neighbours' mean is none; the lamp's light falls
// by less from one to the next.
constexpr double kFaint = 0.25;

// Nothing smaller is looked for where no spot was found.
constexpr double kLeastLookedFor_px = 2.0;

/// The picture with dark elements and its darkest at zero.
picture::AveragedPicture stretch(const picture::AveragedPicture& picture, bool dark,
                                 std::span<std::uint16_t> scratch) {
  const std::size_t count =
      static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px);
  const auto [least, most] = std::minmax_element(picture.pixels, picture.pixels + count);
  const std::uint16_t low = *least;
  const std::uint16_t high = *most;
  for (std::size_t i = 0; i < count; ++i) {
    scratch[i] =
        static_cast<std::uint16_t>(dark ? picture.pixels[i] - low : high - picture.pixels[i]);
  }
  return {scratch.data(), picture.width_px, picture.height_px};
}

}  // namespace

FinderRefusal LatticeFinder::find(const picture::AveragedPicture& picture,
                                  const FinderOptions& options, std::span<std::uint16_t> scratch,
                                  FoundLattice& found) {
  TUBESIGHT_ASSERT(scratch.size() >= static_cast<std::size_t>(picture.width_px) *
                                         static_cast<std::size_t>(picture.height_px));
  found.elements.clear();
  least_contrast_ = options.least_contrast;
  if (const FinderRefusal refusal = find_blobs(picture, options); refusal != FinderRefusal::kNone) {
    return refusal;
  }
  growth_.grow(blobs_, true, grown_[0]);
  growth_.grow(blobs_, false, grown_[1]);
  found.dark = grown_[0].places.size() >= grown_[1].places.size();
  const Growth& growth = grown_[found.dark ? 0 : 1];
  if (growth.places.empty()) {
    return FinderRefusal::kNoLattice;
  }
  take_places(growth, found);
  const picture::AveragedPicture stretched = stretch(picture, found.dark, scratch);
  measure_all(stretched, found);
  find_centers(found);
  weigh_all(stretched, found);
  drop_strangers(found);
  measure_doubtful(stretched, found);
  complete(stretched, found);
  find_centers(found);  // by centres now, as those before were by the ellipses' own
  weigh_all(stretched, found);
  count_from_zero(found);
  return found.elements.empty() ? FinderRefusal::kNoLattice : FinderRefusal::kNone;
}

FinderRefusal LatticeFinder::find_blobs(const picture::AveragedPicture& picture,
                                        const FinderOptions& options) {
  if (!thresholds_.measure(picture)) {
    return FinderRefusal::kSize;
  }
  // A texture makes thousands of small spots; what is sought may be larger.
  BlobLimits limits = options.blobs;
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    blobs_.clear();
    bool all = true;
    for (const double share : kShares) {
      if (!thresholds_.choose(share, options.least_contrast)) {
        return FinderRefusal::kFlat;
      }
      all = scan_.scan(picture, thresholds_, limits, blobs_) && all;
    }
    if (all) {
      return FinderRefusal::kNone;
    }
    limits.least_area_px2 *= 3.0;
  }
  return FinderRefusal::kTooMany;
}

bool LatticeFinder::in_table(std::int32_t row, std::int32_t column) const {
  return std::min(row, column) >= -kMargin && std::max(row, column) < kSide - kMargin;
}

std::int16_t& LatticeFinder::entry(std::int32_t row, std::int32_t column) {
  return table_[static_cast<std::size_t>((row + kMargin) * kSide + column + kMargin)];
}

std::int16_t LatticeFinder::entry(std::int32_t row, std::int32_t column) const {
  return in_table(row, column)
             ? table_[static_cast<std::size_t>((row + kMargin) * kSide + column + kMargin)]
             : std::int16_t{-1};
}

void LatticeFinder::fill_table(const FoundLattice& found) {
  table_.fill(-1);
  for (std::int32_t i = 0; i < found.elements.size(); ++i) {
    entry(found.elements[i].row, found.elements[i].column) = static_cast<std::int16_t>(i);
  }
}

void LatticeFinder::take_places(const Growth& growth, FoundLattice& found) {
  found.steps = growth.steps;
  for (const Place& place : growth.places) {
    LatticeElement element;
    element.row = place.row;
    element.column = place.column;
    element.ellipse = blobs_[place.blob].ellipse;
    element.center_px = element.ellipse.center_px;
    static_cast<void>(found.elements.try_push_back(element));
  }
  fill_table(found);
}

/// The elements up to two steps off, or three where that is few.
MapPoints LatticeFinder::around(const FoundLattice& found, std::int32_t row, std::int32_t column,
                                bool with_itself) const {
  MapPoints points;
  constexpr std::int32_t kEnough = 9;
  for (const std::int32_t reach : {2, 3}) {
    points.clear();
    for (std::int32_t down = -reach; down <= reach; ++down) {
      for (std::int32_t right = -reach; right <= reach; ++right) {
        const std::int16_t i = entry(row + down, column + right);
        if (i >= 0 && (with_itself || down != 0 || right != 0)) {
          static_cast<void>(points.try_push_back({{right, down}, found.elements[i].center_px}));
        }
      }
    }
    if (points.size() >= kEnough) {
      break;
    }
  }
  return points;
}

/// Leaves out what does not look as its neighbours let expect, a plug's dark inside, say. Such a
/// one makes strangers of those around it, too: of each neighbourhood the worst alone goes, and
/// then they are looked at again.
void LatticeFinder::drop_strangers(FoundLattice& found) {
  constexpr int kRounds = 8;
  std::array<float, kMaxElements> strange{};
  for (int round = 0; round < kRounds; ++round) {
    // All are judged before one goes: the table counts in the list as it is.
    const std::int32_t before = found.elements.size();
    for (std::int32_t i = 0; i < before; ++i) {
      strange[static_cast<std::size_t>(i)] = how_strange(found, found.elements[i]);
    }
    std::int32_t kept = 0;
    for (std::int32_t i = 0; i < before; ++i) {
      if (!is_worst(found, strange, i)) {
        found.elements[kept++] = found.elements[i];
      }
    }
    found.elements.truncate(kept);
    fill_table(found);
    if (kept == before) {
      break;
    }
  }
}

/// Whether an element stands out far less than its neighbours: a smudge where one would be.
bool LatticeFinder::is_faint(const FoundLattice& found, const LatticeElement& element) const {
  double sum = 0.0;
  double count = 0.0;
  for (std::int32_t i = 0; i < 9; ++i) {
    const std::int16_t k = entry(element.row + i / 3 - 1, element.column + i % 3 - 1);
    if (k >= 0 && i != 4 && found.elements[k].contrast >= 0.0) {
      sum += found.elements[k].contrast;
      count += 1.0;
    }
  }
  return element.contrast >= 0.0 && element.contrast * count < kFaint * sum;
}

/// Measures again, from where the neighbours expect it, what is less like them than it should be:
/// the spot was joined to a shadow beside it, and the edge followed.
void LatticeFinder::measure_doubtful(const picture::AveragedPicture& stretched,
                                     FoundLattice& found) {
  for (LatticeElement& element : found.elements) {
    LocalMap map;
    if (!map.fit(around(found, element.row, element.column, false))) {
      continue;
    }
    const double strange = strangeness(map, element.ellipse, found.steps, kStranger);
    LatticeElement again = element;
    again.ellipse = map.element(found.steps);
    if (strange > kDoubtful && half_axes(again.ellipse).y() >= kLeastMeasured_px &&
        look_for_edge(stretched, found.steps, element_, again) &&
        strangeness(map, again.ellipse, found.steps, kStranger) < strange) {
      again.center_px = map.center_of(again.ellipse);
      element = again;
    }
  }
}

/// strangeness() of an element by its neighbours; 0 where they do not tell.
float LatticeFinder::how_strange(const FoundLattice& found, const LatticeElement& element) const {
  if (is_faint(found, element)) {
    return static_cast<float>(kMostStrange);
  }
  LocalMap map;
  return map.fit(around(found, element.row, element.column, false))
             ? static_cast<float>(strangeness(map, element.ellipse, found.steps, kStranger))
             : 0.0F;
}

/// Whether an element is a stranger, and none beside it is a worse one.
bool LatticeFinder::is_worst(const FoundLattice& found,
                             const std::array<float, kMaxElements>& strange,
                             std::int32_t index) const {
  const LatticeElement& element = found.elements[index];
  const float own = strange[static_cast<std::size_t>(index)];
  float worst = 1.0F;
  for (std::int32_t i = 0; i < 9; ++i) {
    const std::int16_t k = entry(element.row + i / 3 - 1, element.column + i % 3 - 1);
    worst = k >= 0 ? std::max(worst, strange[static_cast<std::size_t>(k)]) : worst;
  }
  return own >= worst && own > 1.0F;
}

void LatticeFinder::measure_all(const picture::AveragedPicture& stretched, FoundLattice& found) {
  double grown = 0.0;
  double measured = 0.0;
  for (LatticeElement& element : found.elements) {
    const double room = room_of(element.ellipse, found.steps);
    if (half_axes(element.ellipse).y() < kLeastMeasured_px) {
      static_cast<void>(weigh_spot(stretched, room, element.ellipse));
      continue;
    }
    ElementEdge edge;
    if (measure_element(stretched, element.ellipse, {kFineReach_px, room}, element_, edge) &&
        edge.share >= kLeastShare && axes_by(element.ellipse, edge.ellipse).y() > kLeastOfSpot &&
        axes_by(element.ellipse, edge.ellipse).x() < kMostOfSpot) {
      grown += std::sqrt(std::sqrt(edge.ellipse.shape_px2.determinant() /
                                   element.ellipse.shape_px2.determinant()));
      measured += 1.0;
      element.ellipse = edge.ellipse;
      element.share = edge.share;
      element.rms_px = edge.rms_px;
    } else if (half_axes(element.ellipse).y() < kMostWeighed_px) {
      static_cast<void>(weigh_spot(stretched, room, element.ellipse));
    }
  }
  // The steps are in radii: those of the edges from here on, not of the thresholds' spots.
  if (measured > 0.0) {
    found.steps.column *= measured / grown;
    found.steps.row *= measured / grown;
  }
}

/// The images of the centres, by what the neighbours' say.
void LatticeFinder::find_centers(FoundLattice& found) {
  for (LatticeElement& element : found.elements) {
    LocalMap map;
    if (map.fit(around(found, element.row, element.column, true))) {
      element.center_px = map.center_of(element.ellipse);
    }
  }
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
  if (!map.fit(around(found, row, column, false))) {
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
  const bool small = half_axes(expected).y() < kLeastMeasured_px;
  const bool seen = small ? look_for_spot(stretched, found.elements[from].ellipse, found.steps,
                                          least_contrast_, element)
                          : look_for_edge(stretched, found.steps, element_, element);
  if (!(seen && strangeness(map, element.ellipse, found.steps, kNewcomer) <= 1.0) &&
      (small || !look_for_blob(stretched, map, found, element))) {
    return false;
  }
  element.center_px = map.center_of(element.ellipse);
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

/// The centroids of the elements' areas, by their pixels: what an edge fitted by an ellipse is bent
/// by, and that the light across an element is uneven, does not enter.
void LatticeFinder::weigh_all(const picture::AveragedPicture& stretched, FoundLattice& found) {
  for (LatticeElement& element : found.elements) {
    Ellipse spot = element.ellipse;
    element.contrast = weigh_spot(stretched, room_of(spot, found.steps), spot);
    element.centroid_px = spot.center_px;
  }
}

void LatticeFinder::count_from_zero(FoundLattice& found) {
  std::int32_t row = kMaxElements;
  std::int32_t column = kMaxElements;
  for (const LatticeElement& element : found.elements) {
    row = std::min(row, element.row);
    column = std::min(column, element.column);
  }
  for (LatticeElement& element : found.elements) {
    element.row -= row;
    element.column -= column;
  }
  std::sort(found.elements.begin(), found.elements.end(),
            [](const LatticeElement& a, const LatticeElement& b) {
              return a.row != b.row ? a.row < b.row : a.column < b.column;
            });
}

}  // namespace tubesight::core::detection
