#pragma once

#include <Eigen/Core>

namespace tubesight::core::calibration {

/// Derivatives of alpha, beta, gamma (degrees) of R = Rz(alpha) Ry(beta) Rx(gamma) by a rotation
/// vector (rad) on the left. Not defined at beta = +-90 degrees.
[[nodiscard]] Eigen::Matrix3d angle_slope_deg(const Eigen::Matrix3d& rotation);

}  // namespace tubesight::core::calibration
