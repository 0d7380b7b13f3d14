#include "core/detection/lattice_finder.h"

#include <algorithm>
#include <cmath>

#include "core/base/assert.h"
#include "core/detection/expected_element.h"
#include "core/detection/specks.h"
#include "core/detection/spot_weight.h"

namespace tubesight::core::detection {
namespace {

// A bright rim beside a dim sheet wants a low threshold, a dim gap between bright rims a high one.
constexpr std::array kShares = {0.5, 0.25};

// An edge measured around a spot has the spot's own form to this.
constexpr double kLeastOfSpot = 0.85;
constexpr double kMostOfSpot = 1.2;

// Above this half axis the light across it is uneven, and its pixels say it better.
constexpr double kMostWeighed_px = 10.0;

// One that stands out less than this share of its neighbours' mean is none; the lamp's light falls
// by less from one to the next.
constexpr double kFaint = 0.25;

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
  // The picture to look at: specks of noise set the thresholds of a dim one.
  const picture::AveragedPicture clean =
      options.with_faint ? remove_specks(picture, scratch) : picture;
  if (const FinderRefusal refusal = find_blobs(clean, options, kShares);
      refusal != FinderRefusal::kNone) {
    return refusal;
  }
  growth_.grow(blobs_, true, grown_[0]);
  growth_.grow(blobs_, false, grown_[1]);
  const auto worth = [&](const Growth& growth) {
    return options.with_faint ? area_of(growth) : static_cast<double>(growth.places.size());
  };
  found.dark = worth(grown_[0]) >= worth(grown_[1]);
  const Growth& growth = grown_[found.dark ? 0 : 1];
  if (growth.places.empty()) {
    return FinderRefusal::kNoLattice;
  }
  take_places(growth, found);
  const picture::AveragedPicture stretched = stretch(clean, found.dark, scratch);
  measure_all(stretched, found);
  if (options.with_faint && found.dark && has_few_edges(found) &&
      !look_darker(stretched, options, found)) {
    static_cast<void>(find_blobs(stretched, options, kShares));  // those of the lattice found
    fill_table(found);
  }
  straighten(stretched, found);
  find_centers(found);
  weigh_all(stretched, found);
  drop_strangers(found);
  measure_steps(found);
  measure_doubtful(stretched, found);
  complete(stretched, found);
  straighten(stretched, found);
  measure_doubtful(stretched, found);
  drop_unsure(found);
  if (options.with_faint && found.dark) {
    drop_closed(stretched, found);
    settle(stretched, found);
    add_faint(stretched, found);
  }
  find_centers(found);  // by centres now, as those before were by the ellipses' own
  weigh_all(stretched, found);
  count_from_zero(found);
  return found.elements.empty() ? FinderRefusal::kNoLattice : FinderRefusal::kNone;
}

FinderRefusal LatticeFinder::find_blobs(const picture::AveragedPicture& picture,
                                        const FinderOptions& options,
                                        std::span<const double> shares) {
  if (!thresholds_.measure(picture)) {
    return FinderRefusal::kSize;
  }
  // A texture makes thousands of small spots; what is sought may be larger.
  BlobLimits limits = options.blobs;
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    blobs_.clear();
    bool all = true;
    for (const double share : shares) {
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

/// strangeness() of an element by its neighbours; 0 where they do not tell.
float LatticeFinder::how_strange(const FoundLattice& found, const LatticeElement& element) const {
  if (is_faint(found, element) ||
      is_closed(element, black_around(found, element.row, element.column))) {
    return static_cast<float>(kMostStrange);
  }
  LocalMap map;
  return map.fit(around(found, element.row, element.column, false), lens_)
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

/// Learns how the lens bends the rows of what was found.
void LatticeFinder::straighten(const picture::AveragedPicture& stretched,
                               const FoundLattice& found) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const LatticeElement& element : found.elements) {
    mean += Eigen::Vector2d(element.column, element.row) / found.elements.size();
  }
  std::size_t count = 0;
  for (const LatticeElement& element : found.elements) {
    indexed_[count++] = {Eigen::Vector2d(element.column, element.row) - mean, element.center_px};
  }
  lens_ = find_bend(std::span<const IndexedPoint>(indexed_).first(count),
                    {stretched.width_px, stretched.height_px});
}

/// The steps in radii again, by the edges that were measured: what the spots said of them is as
/// rough as their outlines.
void LatticeFinder::measure_steps(FoundLattice& found) {
  std::size_t count = 0;
  for (const LatticeElement& element : found.elements) {
    LocalMap map;
    if (element.share == 0.0 || !map.fit(around(found, element.row, element.column, true), lens_)) {
      continue;
    }
    // The element as an ellipse of the index plane.
    const Eigen::Matrix2d back = map.slope().inverse();
    const Eigen::Matrix2d form = back * element.ellipse.shape_px2 * back.transpose();
    forms_[0][count] = form(0, 0);
    forms_[1][count] = form(0, 1);
    forms_[2][count++] = form(1, 1);
  }
  constexpr std::size_t kLeast = 3;
  if (count < kLeast) {
    return;
  }
  std::array<double, 3> middle{};
  for (std::size_t i = 0; i < middle.size(); ++i) {
    double* const at = forms_[i].data() + count / 2;
    std::nth_element(forms_[i].data(), at, forms_[i].data() + count);
    middle[i] = *at;
  }
  // Its inverse has the products of the steps.
  const double determinant = middle[0] * middle[2] - middle[1] * middle[1];
  if (!(determinant > 0.0)) {
    return;
  }
  const Eigen::Vector2d along = found.steps.column.normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  const double length = std::sqrt(middle[2] / determinant);
  const double side = across.dot(found.steps.row) < 0.0 ? -1.0 : 1.0;
  found.steps.column = length * along;
  found.steps.row =
      -middle[1] / determinant / length * along + side * std::sqrt(1.0 / middle[2]) * across;
}

/// The images of the centres, by what the neighbours' say.
void LatticeFinder::find_centers(FoundLattice& found) {
  for (LatticeElement& element : found.elements) {
    LocalMap map;
    if (map.fit(around(found, element.row, element.column, true), lens_)) {
      element.center_px = map.center_of(element.ellipse);
    }
  }
}

/// The centroids of the elements' areas, by their pixels: what an edge fitted by an ellipse is bent
/// by, and that the light across an element is uneven, does not enter.
void LatticeFinder::weigh_all(const picture::AveragedPicture& stretched, FoundLattice& found) {
  for (LatticeElement& element : found.elements) {
    Ellipse spot = element.ellipse;
    element.levels = measure_levels(stretched, element.ellipse);
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
    element.share = element.by_contrast ? 0.0 : element.share;
  }
  std::sort(found.elements.begin(), found.elements.end(),
            [](const LatticeElement& a, const LatticeElement& b) {
              return a.row != b.row ? a.row < b.row : a.column < b.column;
            });
}

}  // namespace tubesight::core::detection
