#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/base/transform.h"

namespace tubesight::core::rendering {

/// Change of a pixel's ray (x, y, 1) by its column u and line v.
struct RaySlopes {
  double xu, xv, yu, yv;
};

/// The camera of conventions.md in plain double, written anew: a mistake in core/camera would hide
/// if the pictures that test it were drawn with it.
class Projection {
 public:
  Projection() = default;

  /// kOutOfRange: a length, count or scale not above zero or not finite, or distortion that folds
  /// the picture over within its frame.
  [[nodiscard]] static Result<Projection> make(const CameraSettings& settings);

  /// The ray (x, y, 1) of a full-frame pixel, camera frame: closed form [Fallon eq. 4.5-4.9].
  [[nodiscard]] Eigen::Vector3d ray(double u_px, double v_px) const {
    const double x = (u_px - center_u_px_) * unit_u_;
    const double y = (v_px - center_v_px_) * unit_v_;
    const double r2 = x * x + y * y;
    const double factor = 1.0 + r2 * (k_ + r2 * k2_);
    return {x * factor, y * factor, 1.0};
  }

  /// How the ray changes around a pixel.
  [[nodiscard]] RaySlopes ray_slopes(double u_px, double v_px) const {
    const double x = (u_px - center_u_px_) * unit_u_;
    const double y = (v_px - center_v_px_) * unit_v_;
    const double r2 = x * x + y * y;
    const double factor = 1.0 + r2 * (k_ + r2 * k2_);
    const double slope = 2.0 * k_ + 4.0 * k2_ * r2;
    return {unit_u_ * (factor + x * x * slope), unit_v_ * x * y * slope, unit_u_ * x * y * slope,
            unit_v_ * (factor + y * y * slope)};
  }

  /// The pixel of a point of the camera frame, mm; empty when it lies behind the camera, over 75
  /// degrees off its axis or where the distortion folds over.
  [[nodiscard]] std::optional<std::array<double, 2>> pixel(const Eigen::Vector3d& point_mm) const;

  // The same numbers for pixel loops: x = (u - center_u_px) unit_u, distorted, at unit distance.
  [[nodiscard]] double center_u_px() const { return center_u_px_; }
  [[nodiscard]] double center_v_px() const { return center_v_px_; }
  [[nodiscard]] double unit_u() const { return unit_u_; }
  [[nodiscard]] double unit_v() const { return unit_v_; }
  [[nodiscard]] double k() const { return k_; }
  [[nodiscard]] double k2() const { return k2_; }

 private:
  double center_u_px_ = 0.0;
  double center_v_px_ = 0.0;
  double unit_u_ = 1.0;  // distorted plane at unit distance, per pixel
  double unit_v_ = 1.0;
  double k_ = 0.0;  // k EFL^2
  double k2_ = 0.0;
};

/// T_camera_tool of the settings.
[[nodiscard]] Transform<frames::Camera, frames::Tool> camera_tool_of(const ToolSettings& tool);

}  // namespace tubesight::core::rendering
