#include "core/rendering/projection.h"

#include <algorithm>
#include <cmath>

namespace tubesight::core::rendering {
namespace {

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

/// Slope of r (1 + k r^2 + k2 r^4).
double slope(double r2, double k, double k2) { return 1.0 + r2 * (3.0 * k + 5.0 * k2 * r2); }

}  // namespace

Result<Projection> Projection::make(const CameraSettings& settings) {
  if (settings.width_px < 1 || settings.height_px < 1 || settings.sensor_columns < 1 ||
      settings.frame_columns < 1 || !positive(settings.focal_length_mm) ||
      !positive(settings.cell_width_mm) || !positive(settings.cell_height_mm) ||
      !positive(settings.horizontal_scale) || !std::isfinite(settings.center_px[0]) ||
      !std::isfinite(settings.center_px[1]) || !std::isfinite(settings.distortion_per_mm2) ||
      !std::isfinite(settings.distortion2_per_mm4)) {
    return Unexpected(Error::kOutOfRange);
  }
  const double f = settings.focal_length_mm;
  Projection made;
  made.center_u_px_ = settings.center_px[0];
  made.center_v_px_ = settings.center_px[1];
  made.unit_u_ = settings.cell_width_mm * settings.sensor_columns /
                 (settings.horizontal_scale * settings.frame_columns * f);
  made.unit_v_ = settings.cell_height_mm / f;
  made.k_ = settings.distortion_per_mm2 * f * f;
  made.k2_ = settings.distortion2_per_mm4 * f * f * f * f;
  const double x =
      std::max(std::abs(made.center_u_px_), std::abs(settings.width_px - 1 - made.center_u_px_)) *
      made.unit_u_;
  const double y =
      std::max(std::abs(made.center_v_px_), std::abs(settings.height_px - 1 - made.center_v_px_)) *
      made.unit_v_;
  const double corner2 = x * x + y * y;
  for (int step = 1; step <= 64; ++step) {
    if (slope(corner2 * step / 64.0, made.k_, made.k2_) < 0.05) {
      return Unexpected(Error::kOutOfRange);
    }
  }
  return made;
}

std::optional<std::array<double, 2>> Projection::pixel(const Eigen::Vector3d& point_mm) const {
  constexpr double kTangentOf75 = 3.7320508;
  const double z = point_mm.z();
  if (!(z > 1e-6)) {
    return std::nullopt;
  }
  const double x = point_mm.x() / z;
  const double y = point_mm.y() / z;
  const double ideal = std::sqrt(x * x + y * y);
  if (!(ideal < kTangentOf75)) {
    return std::nullopt;
  }
  // Newton's method on r (1 + k r^2 + k2 r^4) = ideal.
  double r = ideal;
  bool converged = false;
  for (int iteration = 0; iteration < 50 && !converged; ++iteration) {
    const double r2 = r * r;
    const double rise = slope(r2, k_, k2_);
    if (!(rise > 0.02)) {
      r *= 0.7;  // beyond the fold: come back towards the axis
      continue;
    }
    const double step = (ideal - r * (1.0 + r2 * (k_ + r2 * k2_))) / rise;
    r += step;
    converged = std::abs(step) <= 1e-14 * (1.0 + ideal);
  }
  if (!converged) {
    return std::nullopt;
  }
  const double factor = ideal > 0.0 ? r / ideal : 1.0;
  return std::array<double, 2>{center_u_px_ + x * factor / unit_u_,
                               center_v_px_ + y * factor / unit_v_};
}

Transform<frames::Camera, frames::Tool> camera_tool_of(const ToolSettings& tool) {
  return {rotation_from_degrees(tool.rotation_deg),
          Eigen::Vector3d(tool.position_mm[0], tool.position_mm[1], tool.position_mm[2])};
}

}  // namespace tubesight::core::rendering
