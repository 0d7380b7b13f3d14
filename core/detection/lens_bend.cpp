#include "core/detection/lens_bend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/detection/local_map.h"

namespace tubesight::core::detection {
namespace {

// Fewer elements are bent by their own errors.
constexpr std::size_t kLeastElements = 12;

// What is so many steps off is no element of the plane, and must not bend the others.
constexpr double kOutlier = 0.25;

// Of the squares of the distances without any bending: what is not better by this is none.
constexpr double kWorthIt = 0.7;

/// The mean square of the elements' distances from one homography, in squared steps.
double misfit(std::span<const IndexedPoint> points, const LensBend& lens) {
  LocalMap map;
  if (!map.fit(points, lens)) {
    return kOutlier * kOutlier;
  }
  const double step = map.shorter_step_px();
  double sum = 0.0;
  for (const IndexedPoint& point : points) {
    const double off = (map.to_pixel(point.index) - point.place_px).squaredNorm() / (step * step);
    sum += std::min(off, kOutlier * kOutlier);
  }
  return sum / static_cast<double>(points.size());
}

}  // namespace

Eigen::Matrix2d LensBend::slope_at(const Eigen::Vector2d& bent_px) const {
  const Eigen::Vector2d off = bent_px - middle_px_;
  return (1.0 + per_px2_ * off.squaredNorm()) * Eigen::Matrix2d::Identity() +
         2.0 * per_px2_ * off * off.transpose();
}

Eigen::Vector2d LensBend::shift_of(const Ellipse& bent) const {
  const Eigen::Vector2d off = bent.center_px - middle_px_;
  return per_px2_ * (0.5 * bent.shape_px2.trace() * off + bent.shape_px2 * off);
}

Ellipse LensBend::straight(const Ellipse& bent) const {
  const Eigen::Matrix2d slope = slope_at(bent.center_px);
  return {straight(bent.center_px) + shift_of(bent), slope * bent.shape_px2 * slope.transpose()};
}

Eigen::Vector2d LensBend::bent(const Eigen::Vector2d& straight_px) const {
  // Newton on the radius; a place that no picture shows stays where the slope would turn.
  const Eigen::Vector2d off = straight_px - middle_px_;
  const double to = off.norm();
  if (per_px2_ == 0.0 || !(to > 0.0)) {
    return straight_px;
  }
  double radius = to;
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    const double square = per_px2_ * radius * radius;
    radius -= (radius * (1.0 + square) - to) / std::max(0.2, 1.0 + 3.0 * square);
  }
  return middle_px_ + radius / to * off;
}

Ellipse LensBend::bent(const Ellipse& straight) const {
  const Eigen::Matrix2d slope = slope_at(bent(straight.center_px)).inverse();
  Ellipse ellipse{bent(straight.center_px), slope * straight.shape_px2 * slope.transpose()};
  ellipse.center_px = bent(straight.center_px - shift_of(ellipse));
  return ellipse;
}

LensBend find_bend(std::span<const IndexedPoint> points, const Eigen::Vector2d& size_px) {
  if (points.size() < kLeastElements) {
    return {};
  }
  const Eigen::Vector2d middle_px = 0.5 * (size_px - Eigen::Vector2d::Ones());
  // At the picture's corner, by its share of the radius there; then between the best and the ones
  // beside it by a parabola.
  const double per_share = 1.0 / middle_px.squaredNorm();
  const auto misfit_at = [&](double share) {
    return misfit(points, {middle_px, share * per_share});
  };
  constexpr double kLeast = -0.16;
  constexpr double kStep = 0.08;
  std::array<double, 9> off{};
  for (std::size_t i = 0; i < off.size(); ++i) {
    off[i] = misfit_at(kLeast + kStep * static_cast<double>(i));
  }
  const auto best =
      static_cast<std::size_t>(std::min_element(off.begin(), off.end()) - off.begin());
  double share = kLeast + kStep * static_cast<double>(best);
  double least = off[best];
  if (best > 0 && best + 1 < off.size()) {
    double left = off[best - 1];
    double right = off[best + 1];
    double step = kStep;
    for (int round = 0; round < 2; ++round) {
      const double curve = left - 2.0 * least + right;
      const double move = curve > 0.0 ? std::clamp(0.5 * (left - right) / curve, -0.5, 0.5) : 0.0;
      const double there = misfit_at(share + move * step);
      if (there < least) {
        share += move * step;
        least = there;
      }
      step *= 0.25;
      left = misfit_at(share - step);
      right = misfit_at(share + step);
    }
  }
  constexpr std::size_t kNone = 2;  // of the shares above
  return least < kWorthIt * off[kNone] ? LensBend(middle_px, share * per_share) : LensBend();
}

}  // namespace tubesight::core::detection
