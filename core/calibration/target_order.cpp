#include "core/calibration/target_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace tubesight::core::calibration {
namespace {

/// A step of the template's lattice: so many lines on, and half spacings along.
struct LatticeStep {
  std::int32_t lines = 0;
  std::int32_t halves = 0;
};

Eigen::Vector2d millimetres(const LatticeStep& step, const Target& target) {
  return {0.5 * step.halves * target.spacing_mm, step.lines * target.row_spacing_mm};
}

bool exists(const LatticeStep& step, const Target& target) {
  const std::int32_t odd = target.lattice == TargetLattice::kStaggered ? step.lines & 1 : 0;
  return ((step.halves - odd) & 1) == 0;
}

// The lens and the ellipses' own errors stay in the steps found.
constexpr double kLikeLength = 0.2;
constexpr double kLikeSine = 0.2;

/// Whether two steps of the template look like those found, which are in radii and turned anyhow.
bool look_alike(const Eigen::Vector2d& column, const Eigen::Vector2d& row,
                const detection::Steps& steps, double radius_mm) {
  const auto like = [&](double mm, double radii) {
    return std::abs(std::log(mm / (radii * radius_mm))) < kLikeLength;
  };
  const auto cosine = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.dot(b) / (a.norm() * b.norm());
  };
  return like(column.norm(), steps.column.norm()) && like(row.norm(), steps.row.norm()) &&
         std::abs(cosine(column, row) - cosine(steps.column, steps.row)) < kLikeSine &&
         column.x() * row.y() - column.y() * row.x() > 0.0;
}

/// Line and half spacings of an element by the two steps, from some origin.
LatticeStep at(const detection::LatticeElement& element, const LatticeStep& column,
               const LatticeStep& row) {
  return {element.column * column.lines + element.row * row.lines,
          element.column * column.halves + element.row * row.halves};
}

/// The lines and half spacings that elements reach.
struct Extent {
  LatticeStep least{kNone, kNone};
  LatticeStep most{-kNone, -kNone};

  static constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();

  void add(const LatticeStep& place) {
    least = {std::min(least.lines, place.lines), std::min(least.halves, place.halves)};
    most = {std::max(most.lines, place.lines), std::max(most.halves, place.halves)};
  }
  [[nodiscard]] bool spans(const LatticeStep& size) const {
    return most.lines - least.lines == size.lines && most.halves - least.halves == size.halves;
  }
};

bool within(const LatticeStep& place, const LatticeStep& origin, const LatticeStep& size) {
  return place.lines >= origin.lines && place.lines <= origin.lines + size.lines &&
         place.halves >= origin.halves && place.halves <= origin.halves + size.halves;
}

// So many of the elements may stand outside the template: a speck beside it that looks like a dot.
constexpr double kMostStrays = 0.03;

/// Where the first line and the leftmost dot stand, when the elements fill the template.
std::optional<LatticeStep> find_origin(const detection::FoundLattice& found, const Target& target,
                                       const LatticeStep& size, const LatticeStep& column,
                                       const LatticeStep& row) {
  Extent all;
  for (const auto& element : found.elements) {
    all.add(at(element, column, row));
  }
  LatticeStep origin;
  for (origin.lines = all.least.lines; origin.lines + size.lines <= all.most.lines;
       ++origin.lines) {
    for (origin.halves = all.least.halves; origin.halves + size.halves <= all.most.halves;
         ++origin.halves) {
      Extent inside;
      std::int32_t strays = 0;
      for (const auto& element : found.elements) {
        const LatticeStep place = at(element, column, row);
        if (within(place, origin, size)) {
          inside.add(place);
        } else {
          ++strays;
        }
      }
      if (inside.spans(size) && strays <= kMostStrays * target.rows * target.columns) {
        return origin;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

OrderRefusal order_on_target(const detection::FoundLattice& found, const Target& target,
                             StaticVector<SeenDot, kMaxDots>& dots) {
  if (found.dark == target.bright) {
    return OrderRefusal::kColour;
  }
  bool form = false;
  const bool staggered = target.lattice == TargetLattice::kStaggered && target.rows > 1;
  const LatticeStep size{target.rows - 1, 2 * (target.columns - 1) + (staggered ? 1 : 0)};
  // All pairs of short steps, in one order, so that like pictures are ordered alike; the steps
  // found are the shortest, at most two lines and two spacings.
  constexpr std::int32_t kLines = 2;
  constexpr std::int32_t kHalves = 4;
  constexpr std::int32_t kSteps = (2 * kLines + 1) * (2 * kHalves + 1);
  const auto step = [](std::int32_t i) {
    return LatticeStep{kLines - i / (2 * kHalves + 1), kHalves - i % (2 * kHalves + 1)};
  };
  for (std::int32_t i = 0; i < kSteps * kSteps; ++i) {
    const LatticeStep column = step(i / kSteps);
    const LatticeStep row = step(i % kSteps);
    if (!exists(column, target) || !exists(row, target) ||
        !look_alike(millimetres(column, target), millimetres(row, target), found.steps,
                    0.5 * target.dot_mm)) {
      continue;
    }
    form = true;
    const std::optional<LatticeStep> origin = find_origin(found, target, size, column, row);
    if (!origin) {
      continue;
    }
    for (const auto& element : found.elements) {
      const LatticeStep place = at(element, column, row);
      // Without contrast there is no centroid: the surroundings by which pixels are weighed leave
      // the picture, and what stands there is the middle of the edge's ellipse.
      if (!within(place, *origin, size) || !(element.contrast > 0.0)) {
        continue;
      }
      SeenDot dot;
      dot.place_mm << millimetres({place.lines - origin->lines, place.halves - origin->halves},
                                  target),
          0.0;
      dot.seen_px = element.centroid_px;
      if (!dots.try_push_back(dot)) {
        return OrderRefusal::kCount;
      }
    }
    return OrderRefusal::kNone;
  }
  return form ? OrderRefusal::kCount : OrderRefusal::kForm;
}

}  // namespace tubesight::core::calibration
