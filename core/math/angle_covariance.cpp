#include "core/math/angle_covariance.h"

#include <cmath>

#include <Eigen/LU>

#include "core/math/rotation.h"

namespace tubesight::core::math {

Eigen::Matrix3d angle_covariance(const Eigen::Matrix3d& rotation,
                                 const Eigen::Matrix3d& vector_covariance) {
  // R = Rz(alpha) Ry(beta) Rx(gamma): the rotation vector of a small change is
  // d(alpha) z + d(beta) Rz y + d(gamma) Rz Ry x, and Rz Ry x is the rotation's first column.
  const auto angles = angles_of(rotation);
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d::UnitZ();
  axes.col(1) = Eigen::Vector3d(-std::sin(angles[0]), std::cos(angles[0]), 0.0);
  axes.col(2) = rotation.col(0);
  const Eigen::Matrix3d inverse = axes.inverse();
  return inverse * vector_covariance * inverse.transpose();
}

}  // namespace tubesight::core::math
