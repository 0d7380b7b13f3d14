#pragma once

#include <optional>

#include <Eigen/Core>

namespace tubesight::core::pose {

/// A conic of the ideal image plane as the symmetric matrix C of [Fallon eq. 5.6], p^T C p = 0.
using Conic = Eigen::Matrix3d;

/// C from the coefficients a, b, c, d, e, f of [Fallon eq. 5.2].
[[nodiscard]] Conic conic_from(const Eigen::Matrix<double, 6, 1>& coefficients);

/// Whether C is a real ellipse, neither empty nor a point.
[[nodiscard]] bool is_ellipse(const Conic& conic);

/// The ellipse's own centre: the pole of the line at infinity. For an ellipse.
[[nodiscard]] Eigen::Vector2d center_of(const Conic& conic);

/// C seen in coordinates p' = T p: T^-T C T^-1 [Fallon eq. 5.10], given T^-1.
[[nodiscard]] Conic transformed(const Conic& conic, const Eigen::Matrix3d& inverse);

/// Half the lengths of the axes, the longer first, and the direction of the longer one.
struct EllipseAxes {
  double major = 0.0;
  double minor = 0.0;
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
};
[[nodiscard]] EllipseAxes axes_of(const Conic& conic);

/// The distance of a point from the conic to first order, f / |grad f|, positive outside an ellipse
/// whose C has a positive a [Sampson1982].
[[nodiscard]] double distance_to(const Conic& conic, const Eigen::Vector2d& point);

}  // namespace tubesight::core::pose
