#include "core/calibration/lens_misfit.h"

#include <algorithm>
#include <cmath>

#include "core/math/small_matrix.h"

namespace tubesight::core::calibration {
namespace {

constexpr int kColumns = 17;
constexpr int kRows = 13;

// What may be no error: a turn of the rays, and a change of EFL.
using Gauge = Eigen::Matrix<double, 2, 4>;

/// How a ray's slopes change when the rays turn by (x, y, z): d(s) of the ray (s, 1) + w x (s, 1);
/// and when EFL grows.
Gauge change_of(const Eigen::Vector2d& s, MapGauge gauge) {
  Gauge change = Gauge::Zero();
  if (gauge != MapGauge::kNone) {
    change.leftCols<3>() << -s.x() * s.y(), 1.0 + s.x() * s.x(), -s.y(),  //
        -1.0 - s.y() * s.y(), s.x() * s.y(), s.x();
  }
  if (gauge == MapGauge::kTurnAndFocal) {
    change.col(3) = s;
  }
  return change;
}

}  // namespace

MapDifference map_difference(const Sensor& sensor, const CameraValues& camera,
                             const CameraValues& lens, const TangentialValues& tangential,
                             MapGauge gauge) {
  const Eigen::Vector2d scale(camera(0) * camera(1) / sensor.column_mm, camera(0) / sensor.row_mm);
  // Calls `take` with the difference in pixels and how the gauge changes it, for a grid of pixels.
  const auto for_each = [&](const auto& take) {
    for (int i = 0; i < kColumns * kRows; ++i) {
      const Eigen::Vector2d pixel((i % kColumns) * (sensor.width_px - 1.0) / (kColumns - 1),
                                  (i / kColumns) * (sensor.height_px - 1.0) / (kRows - 1));
      const Eigen::Vector2d ray = ideal_of(sensor, camera, pixel) / camera(0);
      const Eigen::Vector2d off = ideal_of(sensor, lens, pixel, tangential) / lens(0) - ray;
      take(Eigen::Vector2d(off.cwiseProduct(scale)),
           Gauge(scale.asDiagonal() * change_of(ray, gauge)));
    }
  };
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  // What is not free stays 0.
  normal.diagonal().head<3>().setConstant(gauge == MapGauge::kNone ? 1.0 : 0.0);
  normal(3, 3) = gauge == MapGauge::kTurnAndFocal ? 0.0 : 1.0;
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for_each([&](const Eigen::Vector2d& off, const Gauge& change) {
    normal += change.transpose() * change;
    right += change.transpose() * off;
  });
  math::Cholesky<4> factor;
  const Eigen::Vector4d by =
      factor.factor(normal, 1e-12) ? Eigen::Vector4d(factor.solve(right)) : Eigen::Vector4d::Zero();
  MapDifference result;
  double squares = 0.0;
  for_each([&](const Eigen::Vector2d& off, const Gauge& change) {
    const double left = (off - change * by).norm();
    squares += left * left;
    result.worst_px = std::max(result.worst_px, left);
  });
  result.rms_px = std::sqrt(squares / (kColumns * kRows));
  return result;
}

}  // namespace tubesight::core::calibration
