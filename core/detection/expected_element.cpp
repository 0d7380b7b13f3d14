#include "core/detection/expected_element.h"

#include <algorithm>
#include <cmath>

#include "core/detection/spot_weight.h"

namespace tubesight::core::detection {
namespace {

// Its half axes are these shares of those expected, and a fraction of a pixel: a plug's dark inside
// is smaller, a small dot's form uncertain.
constexpr double kLeastForm = 0.75;
constexpr double kMostForm = 1.3;
constexpr double kForm_px = 0.4;

// Elements are looked for this far from an edge expected, in shares of the shorter half axis.
constexpr double kFirstReach = 0.2;
constexpr double kLeastReach_px = 2.0;
constexpr double kMostReach_px = 12.0;

// An element too small for an edge has this share of its neighbour's contrast.
constexpr double kLeastContrast = 0.5;

}  // namespace

double room_of(const Ellipse& ellipse, const Steps& steps) {
  const double shorter = std::min(steps.column.norm(), steps.row.norm());
  return std::max(1.0, (shorter - 2.0) * half_axes(ellipse).y());
}

Eigen::Vector2d axes_by(const Ellipse& expected, const Ellipse& ellipse) {
  const Eigen::Matrix2d straight = root_of(expected.shape_px2).inverse();
  return half_axes({{0.0, 0.0}, straight * ellipse.shape_px2 * straight});
}

double strangeness(const LocalMap& map, const Ellipse& ellipse, const Steps& steps, double gate) {
  const Ellipse expected = map.element(steps);
  if (!(half_axes(expected).y() > 0.0)) {
    return kMostStrange;
  }
  const double off = (map.center_of(ellipse) - map.to_pixel(Eigen::Vector2d::Zero())).norm();
  const Eigen::Vector2d axes = axes_by(expected, ellipse);
  const double slack = kForm_px / half_axes(expected).y();
  const double strange =
      std::max({off / (gate * map.shorter_step_px()), axes.x() / (kMostForm + slack),
                (kLeastForm - slack) / axes.y()});
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
  if (!measure_element(stretched, expected, {reach, room}, scratch, first) ||
      !measure_element(stretched, first.ellipse, {kFineReach_px, room}, scratch, edge)) {
    return false;
  }
  element.ellipse = edge.ellipse;
  element.share = edge.share;
  element.rms_px = edge.rms_px;
  return edge.share >= kLeastShare;
}

bool measure_spot(const picture::AveragedPicture& stretched, const Steps& steps,
                  ElementScratch& scratch, LatticeElement& element) {
  const double room = room_of(element.ellipse, steps);
  ElementEdge edge;
  if (!measure_element(stretched, element.ellipse, {kFineReach_px, room}, scratch, edge)) {
    return false;
  }
  element.ellipse = edge.ellipse;
  element.share = edge.share;
  element.rms_px = edge.rms_px;
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
