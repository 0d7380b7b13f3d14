#include "core/detection/faint_element.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/LU>

#include "core/base/static_vector.h"
#include "core/detection/element_edge.h"

namespace tubesight::core::detection {
namespace {

constexpr std::size_t kWays = 32;
constexpr std::size_t kParts = 8;  // of the outline, so many ways each

// Across the outline, pixels: outside only what is next to it, as a weld's shadow may lie behind.
constexpr double kOutside_px = 1.5;
constexpr double kJustInside_px = -1.5;
constexpr double kInside_px = -3.0;

// The inside, in shares of the way to the outline; its ends are taken at the last.
constexpr std::array kShares = {0.2, 0.4, 0.6, 0.75};

/// What is read along one way from the middle outwards.
struct Way {
  Eigen::Vector2d unit;  ///< on the circle that the outline shows
  double outside = 0.0;
  double rise = 0.0;  ///< from just inside the outline to just outside
  std::array<double, kShares.size()> inside{};
  std::size_t part = 0;
};
using Ways = StaticVector<Way, kWays>;

void read_ways(const picture::AveragedPicture& picture, const Ellipse& ellipse, Ways& ways) {
  const Eigen::Matrix2d root = root_of(ellipse.shape_px2);
  const Eigen::Matrix2d inverse = ellipse.shape_px2.inverse();
  for (std::size_t i = 0; i < kWays; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kWays;
    Way way;
    way.unit << std::cos(angle), std::sin(angle);
    way.part = i * kParts / kWays;
    const Eigen::Vector2d off = root * way.unit;
    const Eigen::Vector2d across = (inverse * off).normalized();
    const Eigen::Vector2d outermost = ellipse.center_px + off + kOutside_px * across;
    if (outermost.minCoeff() < 1.0 || outermost.x() > picture.width_px - 2.0 ||
        outermost.y() > picture.height_px - 2.0) {
      continue;
    }
    // The middle may be beyond the picture where the outline is cut off.
    const auto level = [&](const Eigen::Vector2d& at) {
      return level_at(picture, {std::clamp(at.x(), 0.0, picture.width_px - 1.0),
                                std::clamp(at.y(), 0.0, picture.height_px - 1.0)});
    };
    const auto beside = [&](double distance_px) {
      return level(ellipse.center_px + off + distance_px * across);
    };
    way.outside = beside(kOutside_px);
    way.rise = way.outside - 0.5 * (beside(kJustInside_px) + beside(kInside_px));
    for (std::size_t k = 0; k < kShares.size(); ++k) {
      way.inside[k] = level(ellipse.center_px + kShares[k] * off);
    }
    static_cast<void>(ways.try_push_back(way));
  }
}

/// The inside's light as a plane over the circle.
struct Slope {
  double mean = 0.0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  ///< grey levels a radius, to the bright end
  double rms = 0.0;                                    ///< of what is left
};

Slope fit_slope(const Ways& ways) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto each = [&](auto use) {
    for (const Way& way : ways) {
      for (std::size_t k = 0; k < kShares.size(); ++k) {
        use(Eigen::Vector3d(1.0, kShares[k] * way.unit.x(), kShares[k] * way.unit.y()),
            way.inside[k]);
      }
    }
  };
  each([&](const Eigen::Vector3d& row, double level) {
    normal += row * row.transpose();
    right += row * level;
  });
  const Eigen::Vector3d plane = normal.inverse() * right;
  double squares = 0.0;
  each([&](const Eigen::Vector3d& row, double level) {
    squares += (level - row.dot(plane)) * (level - row.dot(plane));
  });
  return {plane.x(), plane.tail<2>(), std::sqrt(squares / normal(0, 0))};
}

/// The darkest part's light around over the median of the parts.
double evenness_around(const Ways& ways) {
  std::array<double, kParts> sum{};
  std::array<double, kParts> count{};
  for (const Way& way : ways) {
    sum[way.part] += way.outside;
    count[way.part] += 1.0;
  }
  StaticVector<double, kParts> parts;
  for (std::size_t i = 0; i < kParts; ++i) {
    if (count[i] > 0.0) {
      static_cast<void>(parts.try_push_back(sum[i] / count[i]));
    }
  }
  std::sort(parts.begin(), parts.end());
  const double median = parts[parts.size() / 2];
  return median > 0.0 ? parts[0] / median : 0.0;
}

/// The scatter of the rise from one way to the next, by the median: a dead pixel is none.
double scatter_of(const Ways& ways) {
  StaticVector<double, kWays> steps;
  for (std::int32_t i = 1; i < ways.size(); ++i) {
    static_cast<void>(steps.try_push_back(std::abs(ways[i].rise - ways[i - 1].rise)));
  }
  double* const middle = steps.begin() + steps.size() / 2;
  std::nth_element(steps.begin(), middle, steps.end());
  constexpr double kOfMedian = 1.048;  // of the difference of two like normal numbers
  return kOfMedian * *middle;
}

/// Moves a place to the best of those around it as long as there is a better one.
template <typename Value>
Eigen::Vector2d climb(double most_px, Value value) {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double best = value(at);
  for (const double step : {2.0, 1.0}) {
    for (bool better = true; better;) {
      better = false;
      const Eigen::Vector2d from = at;
      for (int i = 0; i < 9; ++i) {
        const Eigen::Vector2d there = from + step * Eigen::Vector2d(i % 3 - 1, i / 3 - 1);
        const double level = there.norm() <= most_px ? value(there) : best;
        if (level > best) {
          best = level;
          at = there;
          better = true;
        }
      }
    }
  }
  return at;
}

// Of the contrast at the dark end.
constexpr double kClear = 0.2;

// Fewer ways tell nothing.
constexpr std::int32_t kFewestWays = 12;

}  // namespace

FaintLook look_at_faint(const picture::AveragedPicture& picture, const Ellipse& expected) {
  FaintLook look;
  Ways ways;
  read_ways(picture, expected, ways);
  look.seen = static_cast<double>(ways.size()) / kWays;
  if (ways.size() < kFewestWays) {
    return look;
  }
  const Slope slope = fit_slope(ways);
  const double steepness = slope.gradient.norm();
  const Eigen::Vector2d to_dark = steepness > 0.0 ? Eigen::Vector2d(-slope.gradient / steepness)
                                                  : Eigen::Vector2d(Eigen::Vector2d::UnitX());
  constexpr double kEnd = 0.5;  // the cosine of 60 degrees to each side
  double rise = 0.0;
  double outside = 0.0;
  double count = 0.0;
  for (const Way& way : ways) {
    if (way.unit.dot(to_dark) > kEnd) {
      rise += way.rise;
      outside += way.outside;
      count += 1.0;
    }
  }
  if (!(count > 0.0 && outside > 0.0 && rise > 0.0)) {
    return look;
  }
  look.contrast = rise / count;
  look.sigma = scatter_of(ways) / std::sqrt(count);
  look.slope = steepness / look.contrast;
  const auto clear = std::count_if(
      ways.begin(), ways.end(), [&](const Way& way) { return way.rise > kClear * look.contrast; });
  look.share = static_cast<double>(clear) / ways.size();
  look.light = outside / count;
  look.dark = (slope.mean - kShares.back() * steepness) / look.light;
  look.uneven = slope.rms / look.contrast;
  look.around = evenness_around(ways);
  return look;
}

Ellipse move_to_contrast(const picture::AveragedPicture& picture, const Ellipse& expected) {
  constexpr double kMost = 0.4;  // of the shorter half axis
  constexpr double kMost_px = 6.0;
  Ellipse moved = expected;
  moved.center_px +=
      climb(std::min(kMost_px, kMost * half_axes(expected).y()), [&](const Eigen::Vector2d& off) {
        Ways ways;
        Ellipse there = expected;
        there.center_px += off;
        read_ways(picture, there, ways);
        double sum = 0.0;
        for (const Way& way : ways) {
          sum += way.rise;
        }
        return sum / kWays;
      });
  return moved;
}

bool may_be_beside(const FaintLook& look) {
  constexpr double kLeastContrast = 5.0;
  constexpr double kLeastShare = 0.5;
  return look.contrast > kLeastContrast && look.share > kLeastShare;
}

bool is_open(const FaintLook& look) {
  // Chosen between what was measured in 928 frames of the campaign (docs/accuracy.md).
  constexpr double kLeastSeen = 0.75;
  constexpr double kLeastContrast = 1.0;  // grey levels
  constexpr double kLeastSigmas = 5.0;
  constexpr double kLeastShare = 0.33;
  // A guidetube that hides a place darkens its inside evenly and a part of its outline alone; paper
  // and its shadow have straight edges.
  constexpr double kLeastShareFlat = 0.7;
  constexpr double kLeastShareClear = 0.55;
  // A lamp that fills a bore comes in flat, and leaves the sheet dim. In good light a plug's face
  // that is darker than the sheet is nearer to what a bore would be.
  constexpr double kMostDark = 0.785;
  constexpr double kGoodLight = 40.0;  // grey levels
  constexpr double kMostDarkClear = 0.6;
  constexpr double kLeastSlope = 0.35;  // below, the inside is as even as a plug's face
  constexpr double kLeastDark = -0.2;   // the slope of a plug's steps reaches below that
  constexpr double kMostUneven = 0.35;
  constexpr double kLeastAround = 0.5;
  const bool flat = look.slope < kLeastSlope;
  const bool clear = look.light > kGoodLight;
  const double least_share = flat ? kLeastShareFlat : clear ? kLeastShareClear : kLeastShare;
  return look.seen >= kLeastSeen && look.contrast > kLeastContrast &&
         look.contrast > kLeastSigmas * look.sigma && look.share > least_share &&
         look.dark > kLeastDark && look.dark < (clear || flat ? kMostDarkClear : kMostDark) &&
         look.uneven < kMostUneven && look.around > kLeastAround;
}

bool is_none(const FaintLook& look) {
  constexpr double kLeastSeen = 0.6;
  constexpr double kLeastAround = 0.4;  // behind a guidetube it is less
  constexpr double kMostUneven = 0.5;
  constexpr double kMostDark = 0.9;
  return look.seen >= kLeastSeen && look.around > kLeastAround &&
         (look.uneven > kMostUneven || look.dark > kMostDark);
}

}  // namespace tubesight::core::detection
