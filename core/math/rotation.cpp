#include "core/math/rotation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace tubesight::core::math {

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d result;
  result << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return result;
}

Eigen::Matrix3d exp_rotation(const Eigen::Vector3d& theta) {
  const double angle2 = theta.squaredNorm();
  const double angle = std::sqrt(angle2);
  const bool small = angle < 1e-4;
  const double first = small ? 1.0 - angle2 / 6.0 : std::sin(angle) / angle;
  const double second = small ? 0.5 - angle2 / 24.0 : (1.0 - std::cos(angle)) / angle2;
  const Eigen::Matrix3d cross = skew(theta);
  return Eigen::Matrix3d::Identity() + first * cross + second * (cross * cross);
}

Eigen::Vector3d log_rotation(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double sine = 0.5 * twice_sine.norm();
  const double cosine = 0.5 * (R.trace() - 1.0);
  const double angle = std::atan2(sine, cosine);
  // angle / sin(angle) to the fourth power of the angle
  const double factor = sine < 1e-4 ? 1.0 + angle * angle / 6.0 : angle / sine;
  return 0.5 * factor * twice_sine;
}

Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& rotation) {
  Eigen::Matrix3d result;
  result.col(0) = rotation.col(0).normalized();
  result.col(2) = result.col(0).cross(rotation.col(1)).normalized();
  result.col(1) = result.col(2).cross(result.col(0));
  return result;
}

std::array<double, 3> angles_of(const Eigen::Matrix3d& R) {
  const double cosine = std::sqrt(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0));
  const double beta = std::atan2(-R(2, 0), cosine);
  if (cosine < 1e-9) {
    return {std::atan2(-R(0, 1), R(1, 1)), beta, 0.0};
  }
  // The cosine is positive, so dividing by it changes no quadrant.
  return {std::atan2(R(1, 0), R(0, 0)), beta, std::atan2(R(2, 1), R(2, 2))};
}

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
