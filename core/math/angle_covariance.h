#pragma once

#include <Eigen/Core>

namespace tubesight::core::math {

/// The covariance of the angles alpha, beta, gamma of a rotation (rad) from that of its rotation
/// vector in the outer frame, R_true = exp([theta]x) R. Not defined at beta = ±90 degrees.
[[nodiscard]] Eigen::Matrix3d angle_covariance(const Eigen::Matrix3d& rotation,
                                               const Eigen::Matrix3d& vector_covariance);

}  // namespace tubesight::core::math
