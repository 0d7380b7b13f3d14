#include "core/calibration/dot_sharpness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "core/math/small_matrix.h"

namespace tubesight::core::calibration {
namespace {

constexpr int kDirections = 16;
constexpr double kGreyLevels = 255.0;
// An average of frames that were all cut off; one that was not in 32 lowers it by less.
constexpr double kTop = kGreyLevels - 0.02;

// Real cameras at rest smear by 0.2 to 1.6 px: lines of video along the rows, a lens that sees
// aslant (cal_a, and photographs of four templates).
constexpr double kMostSmeared_px = 2.5;
constexpr double kMostSmeared = 0.25;  // of the radius
// Those cameras' edges are 1.1 to 1.8 px wide.
constexpr double kMostWidth_px = 5.0;
constexpr double kMostWidth = 0.5;       // of the radius
constexpr double kMostSaturated = 0.25;  // of the dots

/// Between pixels; grey levels. The place and its neighbours lie in the picture.
double level_at(const picture::AveragedPicture& picture, const Eigen::Vector2d& at) {
  const auto u = static_cast<std::int32_t>(at.x());
  const auto v = static_cast<std::int32_t>(at.y());
  const double x = at.x() - u;
  const double y = at.y() - v;
  const double upper = (1.0 - x) * picture.at(u, v) + x * picture.at(u + 1, v);
  const double lower = (1.0 - x) * picture.at(u, v + 1) + x * picture.at(u + 1, v + 1);
  return ((1.0 - y) * upper + y * lower) / picture::kGreyScale;
}

bool has_room(const picture::AveragedPicture& picture, const Eigen::Vector2d& center,
              double reach_px) {
  return center.x() - reach_px >= 0.0 && center.y() - reach_px >= 0.0 &&
         center.x() + reach_px < picture.width_px - 1.0 &&
         center.y() + reach_px < picture.height_px - 1.0;
}

/// The middle between an element and its nearest neighbours, in radii.
double middle_of_gap(const detection::FoundLattice& found) {
  constexpr double kFarthest = 1.6;
  const double least = std::min(found.steps.column.norm(), found.steps.row.norm());
  return std::clamp(0.5 * least, 1.1, kFarthest);
}

/// Squares of edges' widths over their directions.
class WidthsByDirection {
 public:
  void add(double angle, double width_px) {
    const Eigen::Vector3d row(1.0, std::cos(2.0 * angle), std::sin(2.0 * angle));
    normal_ += row * row.transpose();
    right_ += width_px * width_px * row;
    ++count_;
  }

  void tell(DotSharpness& sharpness) const {
    math::Cholesky<3> factor;
    if (count_ < kDirections || !factor.factor(normal_)) {
      return;
    }
    const Eigen::Vector3d terms = factor.solve(right_);
    const double swing = terms.tail<2>().norm();
    sharpness.width_px = std::sqrt(std::max(0.0, terms(0) - swing));
    sharpness.smeared_px = std::sqrt(2.0 * swing);
    const double degrees = 0.5 * std::atan2(terms(2), terms(1)) * 180.0 / std::numbers::pi;
    sharpness.smeared_deg = degrees < 0.0 ? degrees + 180.0 : degrees;
  }

 private:
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
  std::int32_t count_ = 0;
};

/// The mean over an ellipse's outline scaled by `share`.
double ring_level(const picture::AveragedPicture& picture, const detection::Ellipse& ellipse,
                  double share) {
  const Eigen::Matrix2d root = detection::root_of(ellipse.shape_px2);
  double sum = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kDirections;
    const Eigen::Vector2d off = root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    sum += level_at(picture, ellipse.center_px + share * off);
  }
  return sum / kDirections;
}

void look_at_edges(const picture::AveragedPicture& picture, const detection::Ellipse& ellipse,
                   double gap, double contrast, WidthsByDirection& widths) {
  constexpr double kInside = 0.3;   // of the radius: from here outward
  constexpr double kStep_px = 0.5;  // a slope is taken over two of them
  const Eigen::Matrix2d root = detection::root_of(ellipse.shape_px2);
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kDirections;
    const Eigen::Vector2d unit(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d off = root * unit;
    // The outline's normal there: S^-1 off, and off = S^(1/2) unit.
    const Eigen::Vector2d normal = root.inverse() * unit;
    const double across = off.dot(normal) / (off.norm() * normal.norm());
    const double reach_px = off.norm();
    double steepest = 0.0;
    for (double t = kInside * reach_px; t + 2.0 * kStep_px <= gap * reach_px; t += kStep_px) {
      const Eigen::Vector2d along = off / reach_px;
      const double slope = (level_at(picture, ellipse.center_px + (t + 2.0 * kStep_px) * along) -
                            level_at(picture, ellipse.center_px + t * along)) /
                           (2.0 * kStep_px);
      steepest = std::max(steepest, std::abs(slope));
    }
    if (steepest > 0.0) {
      // Along the radius an edge is wider than along its normal.
      widths.add(std::atan2(normal.y(), normal.x()), across * contrast / steepest);
    }
  }
}

}  // namespace

DotSharpness dot_sharpness(const picture::AveragedPicture& picture,
                           const detection::FoundLattice& found) {
  constexpr double kInner = 0.4;
  constexpr double kLeastContrast = 5.0;  // grey levels
  DotSharpness sharpness;
  WidthsByDirection widths;
  const double gap = middle_of_gap(found);
  for (const detection::LatticeElement& element : found.elements) {
    const Eigen::Vector2d axes = detection::half_axes(element.ellipse);
    if (!has_room(picture, element.ellipse.center_px, gap * axes.x() + 1.0)) {
      continue;
    }
    const double inside = ring_level(picture, element.ellipse, kInner);
    const double around = ring_level(picture, element.ellipse, gap);
    const double contrast = std::abs(inside - around);
    if (contrast < kLeastContrast) {
      continue;
    }
    ++sharpness.dots;
    sharpness.radius_px += std::sqrt(axes.x() * axes.y());
    sharpness.saturated += inside > kTop ? 1 : 0;
    sharpness.ground_saturated += around > kTop ? 1 : 0;
    look_at_edges(picture, element.ellipse, gap, contrast, widths);
  }
  if (sharpness.dots > 0) {
    sharpness.radius_px /= sharpness.dots;
    widths.tell(sharpness);
  }
  return sharpness;
}

DotFault fault_of(const DotSharpness& sharpness) {
  if (sharpness.saturated > kMostSaturated * sharpness.dots) {
    return DotFault::kSaturated;
  }
  if (sharpness.smeared_px > std::max(kMostSmeared_px, kMostSmeared * sharpness.radius_px)) {
    return DotFault::kSmeared;
  }
  if (sharpness.width_px > std::max(kMostWidth_px, kMostWidth * sharpness.radius_px)) {
    return DotFault::kBlurred;
  }
  return DotFault::kNone;
}

}  // namespace tubesight::core::calibration
