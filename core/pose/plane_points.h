#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/camera/camera_model.h"
#include "core/picture/rim.h"

namespace tubesight::core::pose {

/// A rim point on the ideal image plane at unit distance, distortion taken out [Fallon
/// eq. 4.5-4.9].
struct PlanePoint {
  double x = 0.0;
  double y = 0.0;
  /// Derivatives of (x, y) by (u, v), per pixel: x by u, x by v, y by u, y by v. The gradient of a
  /// function on the plane becomes one in the picture by their transpose.
  double x_u = 0.0;
  double x_v = 0.0;
  double y_u = 0.0;
  double y_v = 0.0;
  double normal_u = 0.0;
  double normal_v = 0.0;
  double weight = 0.0;       ///< 1 / sigma^2, per px^2
  double residual_px = 0.0;  ///< left by the last pass over the points
  double robust = 1.0;       ///< what outlier rejection leaves of the weight, 0..1
};

/// The points of all rims of a picture, rim after rim.
struct PlanePointBuffer {
  std::array<PlanePoint, static_cast<std::size_t>(kMaxTubesInView) * picture::kMaxRimPoints> points;
  std::array<std::int32_t, kMaxTubesInView + 1> first{};  ///< rim i: first[i] .. first[i + 1]
  std::int32_t rims = 0;

  [[nodiscard]] std::span<PlanePoint> of(std::int32_t rim) {
    const auto begin = static_cast<std::size_t>(first[static_cast<std::size_t>(rim)]);
    const auto end = static_cast<std::size_t>(first[static_cast<std::size_t>(rim) + 1]);
    return std::span<PlanePoint>(points).subspan(begin, end - begin);
  }
};

/// Takes the distortion out of every point of every rim. Some 40 operations a point.
void to_plane_points(const camera::CameraModel<double>& camera, const picture::RimList& rims,
                     PlanePointBuffer& buffer);

}  // namespace tubesight::core::pose
