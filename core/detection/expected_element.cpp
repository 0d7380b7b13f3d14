#include "core/detection/expected_element.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "core/detection/spot_weight.h"

namespace tubesight::core::detection {
namespace {

// Half axes are known to no better than this: a small dot's form is uncertain.
constexpr double kForm_px = 0.4;

// Elements are looked for this far from an edge expected, in shares of the shorter half axis.
constexpr double kFirstReach = 0.2;
constexpr double kLeastReach_px = 2.0;
constexpr double kMostReach_px = 12.0;

// An element too small for an edge has this share of its neighbour's contrast.
constexpr double kLeastContrast = 0.5;

// A plug rolled into a tube-end makes more of its inside than this share as bright as what is
// around; a bore that the lamp shines into stays darker than that.
constexpr double kMostBright = 0.13;
constexpr double kAsBright = 0.9;
// Of the edge of a tube-end with such a plug no more than this is to be seen.
constexpr double kMostOfPlugged = 0.93;
// A flush one has no dark at all, which does tell where the light is good.
constexpr double kMostBlack = 0.55;
constexpr double kGoodLight = 40.0;
// In little light noise is as bright; then this share of the outline has to be seen.
constexpr double kLittleLight = 12.0;
constexpr double kMostlySeen = 0.7;

}  // namespace

double room_of(const Ellipse& ellipse, const Steps& steps) {
  const double shorter = std::min(steps.column.norm(), steps.row.norm());
  return std::max(1.0, (shorter - 2.0) * half_axes(ellipse).y());
}

Eigen::Vector2d axes_by(const Ellipse& expected, const Ellipse& ellipse) {
  const Eigen::Matrix2d straight = root_of(expected.shape_px2).inverse();
  return half_axes({{0.0, 0.0}, straight * ellipse.shape_px2 * straight});
}

double strangeness(const LocalMap& map, const Ellipse& ellipse, const Steps& steps,
                   const Likeness& like) {
  const Ellipse expected = map.element(steps);
  if (!(half_axes(expected).y() > 0.0)) {
    return kMostStrange;
  }
  const double off = (map.center_of(ellipse) - map.to_pixel(Eigen::Vector2d::Zero())).norm();
  const Eigen::Vector2d axes = axes_by(expected, ellipse);
  const double slack = kForm_px / half_axes(expected).y();
  const double strange =
      std::max({off / (like.gate * map.shorter_step_px()), axes.x() / (like.most_form + slack),
                (like.least_form - slack) / axes.y()});
  return strange < kMostStrange ? strange : kMostStrange;  // not a number, too
}

bool look_for_edge(const picture::AveragedPicture& stretched, const Steps& steps,
                   ElementScratch& scratch, LatticeElement& element) {
  const Ellipse expected = element.ellipse;
  const double room = room_of(expected, steps);
  const double reach =
      std::clamp(kFirstReach * half_axes(expected).y(), kLeastReach_px, kMostReach_px);
  ElementEdge first;
  ElementEdge edge;
  if (!measure_element(stretched, expected, {reach, room, element.levels.black, true}, scratch,
                       first) ||
      !measure_element(stretched, first.ellipse, {kFineReach_px, room, element.levels.black, true},
                       scratch, edge)) {
    return false;
  }
  element.ellipse = edge.ellipse;
  element.share = edge.share;
  element.rms_px = edge.rms_px;
  element.by_contrast = false;
  return edge.share >= kLeastKnownShare;
}

namespace {

/// The contrast across an outline, outside less inside, grey levels.
struct OutlineContrast {
  double mean = 0.0;
  double sigma = 0.0;  ///< of the mean, by the scatter along the outline
  double share = 0.0;  ///< of the outline where it is clearly there
};

constexpr std::int32_t kWays = 32;

OutlineContrast contrast_along(const picture::AveragedPicture& picture, const Ellipse& ellipse) {
  const Eigen::Matrix2d root = root_of(ellipse.shape_px2);
  const Eigen::Matrix2d inverse = ellipse.shape_px2.inverse();
  double sum = 0.0;
  double square = 0.0;
  std::array<double, kWays> all{};
  std::size_t count = 0;
  for (std::int32_t i = 0; i < kWays; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kWays;
    const Eigen::Vector2d off = root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d across = (inverse * off).normalized();
    const Eigen::Vector2d at = ellipse.center_px + off;
    constexpr double kNear_px = 1.5;
    constexpr double kReach_px = 3.0;  // and the pixels beside
    if (at.minCoeff() < kReach_px + 1.0 || at.x() > picture.width_px - kReach_px - 2.0 ||
        at.y() > picture.height_px - kReach_px - 2.0) {
      continue;
    }
    // Outside only what is next to it: a weld's shadow may lie behind.
    const double rise = level_at(picture, at + kNear_px * across) -
                        0.5 * (level_at(picture, at - kNear_px * across) +
                               level_at(picture, at - kReach_px * across));
    all[count++] = rise;
    sum += rise;
    square += rise * rise;
  }
  OutlineContrast contrast;
  if (2 * count < kWays) {
    return contrast;
  }
  const auto n = static_cast<double>(count);
  contrast.mean = sum / n;
  contrast.sigma = std::sqrt(std::max(0.0, square / n - contrast.mean * contrast.mean) / n);
  const double clear = std::max(0.7, 0.3 * contrast.mean);
  contrast.share = static_cast<double>(std::count_if(all.begin(), all.begin() + count,
                                                     [&](double rise) { return rise > clear; })) /
                   kWays;
  return contrast;
}

}  // namespace

bool look_for_contrast(const picture::AveragedPicture& stretched, LatticeElement& element) {
  constexpr int kSide = 2;  // pixels; the best place is within, not at the rim
  const Ellipse expected = element.ellipse;
  OutlineContrast best;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  for (int down = -kSide; down <= kSide; ++down) {
    for (int right = -kSide; right <= kSide; ++right) {
      Ellipse moved = expected;
      moved.center_px += Eigen::Vector2d(right, down);
      const OutlineContrast contrast = contrast_along(stretched, moved);
      if (contrast.mean > best.mean) {
        best = contrast;
        place << right, down;
      }
    }
  }
  constexpr double kLeastMean = 1.0;
  constexpr double kLeastSigmas = 5.0;
  if (!(best.mean > std::max(kLeastMean, kLeastSigmas * best.sigma)) || best.share < kLeastShare ||
      place.cwiseAbs().maxCoeff() >= kSide) {
    return false;
  }
  element.ellipse.center_px += place;
  element.share = best.share;
  element.rms_px = 0.0;
  element.by_contrast = true;
  return true;
}

bool is_closed(const LatticeElement& element, double black) {
  const Levels& levels = element.levels;
  const double light = levels.around - black;
  if (light > kGoodLight && levels.black - black > kMostBlack * light) {
    return true;
  }
  if (levels.around - levels.black < kLittleLight) {
    return levels.bright_share > kMostBright && element.share < kMostlySeen;
  }
  return levels.bright_share > kMostBright && levels.bright > kAsBright * levels.around &&
         element.share < kMostOfPlugged;
}

bool measure_spot(const picture::AveragedPicture& stretched, const Steps& steps,
                  ElementScratch& scratch, LatticeElement& element) {
  const double room = room_of(element.ellipse, steps);
  ElementEdge edge;
  if (!measure_element(stretched, element.ellipse, {kFineReach_px, room, element.levels.black},
                       scratch, edge)) {
    return false;
  }
  element.ellipse = edge.ellipse;
  element.share = edge.share;
  element.rms_px = edge.rms_px;
  element.by_contrast = false;
  return edge.share >= kLeastShare;
}

bool look_for_spot(const picture::AveragedPicture& stretched, const Ellipse& neighbour,
                   const Steps& steps, double least_contrast, LatticeElement& element) {
  Ellipse other = neighbour;
  const double usual = weigh_spot(stretched, room_of(other, steps), other);
  const double contrast = weigh_spot(stretched, room_of(element.ellipse, steps), element.ellipse);
  return usual > 0.0 && contrast > std::max(least_contrast, kLeastContrast * usual);
}

}  // namespace tubesight::core::detection
