#include "core/calibration/lens_misfit.h"

#include <algorithm>
#include <cmath>

#include "core/math/small_matrix.h"

namespace tubesight::core::calibration {
namespace {

constexpr int kColumns = 17;
constexpr int kRows = 13;

// What no error is: a turn of the rays, and a change of EFL.
using Gauge = Eigen::Matrix<double, 2, 4>;

/// How a ray's slopes change when the rays turn by (x, y, z): d(s) of the ray (s, 1) + w x (s, 1);
/// and when EFL grows.
Gauge gauge_of(const Eigen::Vector2d& s, bool free_focal) {
  Gauge turn;
  turn << -s.x() * s.y(), 1.0 + s.x() * s.x(), -s.y(), free_focal ? s.x() : 0.0,  //
      -1.0 - s.y() * s.y(), s.x() * s.y(), s.x(), free_focal ? s.y() : 0.0;
  return turn;
}

}  // namespace

MapDifference map_difference(const Sensor& sensor, const CameraValues& camera,
                             const CameraValues& lens, const TangentialValues& tangential,
                             bool free_focal) {
  const Eigen::Vector2d scale(camera(0) * camera(1) / sensor.column_mm, camera(0) / sensor.row_mm);
  // Calls `take` with the difference in pixels and how a turn changes it, for a grid of pixels.
  const auto for_each = [&](const auto& take) {
    for (int i = 0; i < kColumns * kRows; ++i) {
      const Eigen::Vector2d pixel((i % kColumns) * (sensor.width_px - 1.0) / (kColumns - 1),
                                  (i / kColumns) * (sensor.height_px - 1.0) / (kRows - 1));
      const Eigen::Vector2d ray = ideal_of(sensor, camera, pixel) / camera(0);
      const Eigen::Vector2d off = ideal_of(sensor, lens, pixel, tangential) / lens(0) - ray;
      take(Eigen::Vector2d(off.cwiseProduct(scale)),
           Gauge(scale.asDiagonal() * gauge_of(ray, free_focal)));
    }
  };
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  normal(3, 3) = free_focal ? 0.0 : 1.0;
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for_each([&](const Eigen::Vector2d& off, const Gauge& turn) {
    normal += turn.transpose() * turn;
    right += turn.transpose() * off;
  });
  math::Cholesky<4> factor;
  const Eigen::Vector4d by =
      factor.factor(normal, 1e-12) ? Eigen::Vector4d(factor.solve(right)) : Eigen::Vector4d::Zero();
  MapDifference result;
  double squares = 0.0;
  for_each([&](const Eigen::Vector2d& off, const Gauge& turn) {
    const double left = (off - turn * by).norm();
    squares += left * left;
    result.worst_px = std::max(result.worst_px, left);
  });
  result.rms_px = std::sqrt(squares / (kColumns * kRows));
  return result;
}

}  // namespace tubesight::core::calibration
