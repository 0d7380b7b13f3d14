#pragma once

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tubesight::core::math {

/// The matrix of the vector product: skew(a) b = a x b.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// The rotation by |theta| about theta [Sola2018 eq. 132]. Below 1e-4 rad the series to the second
/// power, right to 1e-13.
[[nodiscard]] Eigen::Matrix3d exp_rotation(const Eigen::Vector3d& theta);

/// The rotation vector of a rotation, for angles up to pi - 1e-6 [Sola2018 eq. 133].
[[nodiscard]] Eigen::Vector3d log_rotation(const Eigen::Matrix3d& rotation);

/// The rotation nearest to a matrix that is one up to rounding: the columns made orthonormal.
[[nodiscard]] Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& rotation);

/// alpha, beta, gamma of R = Rz(alpha) Ry(beta) Rx(gamma) in rad [Fallon eq. 5.29-5.31]. At
/// beta = +-90 degrees, where only their sum or difference shows, gamma is 0.
[[nodiscard]] std::array<double, 3> angles_of(const Eigen::Matrix3d& rotation);

/// The covariance of the angles alpha, beta, gamma of a rotation (rad) from that of its rotation
/// vector in the outer frame, R_true = exp([theta]x) R. Not defined at beta = ±90 degrees.
[[nodiscard]] Eigen::Matrix3d angle_covariance(const Eigen::Matrix3d& rotation,
                                               const Eigen::Matrix3d& vector_covariance);

}  // namespace tubesight::core::math
