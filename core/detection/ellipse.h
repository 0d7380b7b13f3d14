#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>

namespace tubesight::core::detection {

/// An ellipse of the picture: (p - center)^T shape^-1 (p - center) = 1, full-frame pixels.
struct Ellipse {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d shape_px2 = Eigen::Matrix2d::Identity();  ///< symmetric, positive definite
};

/// Half the ellipse's extent along a direction that need not have unit length.
[[nodiscard]] inline double reach_along(const Ellipse& ellipse, const Eigen::Vector2d& direction) {
  const Eigen::Matrix2d& s = ellipse.shape_px2;
  const double determinant = s(0, 0) * s(1, 1) - s(0, 1) * s(0, 1);
  const double form = s(1, 1) * direction.x() * direction.x() -
                      2.0 * s(0, 1) * direction.x() * direction.y() +
                      s(0, 0) * direction.y() * direction.y();
  return std::sqrt(determinant * direction.squaredNorm() / form);
}

/// The symmetric square root of the shape: it turns the unit circle into the ellipse.
[[nodiscard]] inline Eigen::Matrix2d root_of(const Eigen::Matrix2d& shape) {
  const double root = std::sqrt(shape.determinant());
  return (shape + root * Eigen::Matrix2d::Identity()) / std::sqrt(shape.trace() + 2.0 * root);
}

/// Half the lengths of the axes, the longer first.
[[nodiscard]] inline Eigen::Vector2d half_axes(const Ellipse& ellipse) {
  const Eigen::Matrix2d& s = ellipse.shape_px2;
  const double middle = 0.5 * (s(0, 0) + s(1, 1));
  const double swing = std::hypot(0.5 * (s(0, 0) - s(1, 1)), s(0, 1));
  return {std::sqrt(middle + swing), std::sqrt(std::max(0.0, middle - swing))};
}

}  // namespace tubesight::core::detection
