#include "core/calibration/angle_slope.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/math/rotation.h"

namespace tubesight::core::calibration {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

}  // namespace

Eigen::Matrix3d angle_slope_deg(const Eigen::Matrix3d& rotation) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix3d slope;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d off = kStep * Eigen::Vector3d::Unit(i);
    const std::array<double, 3> more = math::angles_of(math::exp_rotation(off) * rotation);
    const std::array<double, 3> less = math::angles_of(math::exp_rotation(-off) * rotation);
    for (int k = 0; k < 3; ++k) {
      const double turn = more[static_cast<std::size_t>(k)] - less[static_cast<std::size_t>(k)];
      slope(k, i) = kDegrees * std::remainder(turn, 2.0 * std::numbers::pi) / (2.0 * kStep);
    }
  }
  return slope;
}

}  // namespace tubesight::core::calibration
