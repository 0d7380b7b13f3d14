#pragma once

#include <optional>

#include "core/base/constant.h"
#include "core/base/scalar.h"
#include "core/base/vector3.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Camera-frame point to the image plane at unit distance; empty nearer than 8 mm to the projection
/// point's plane, behind it or over 63 degrees off the axis.
template <Scalar S>
[[nodiscard]] std::optional<Vector2<Ratio<S>>> to_plane(const Vector3<Mm<S>>& point) {
  if (point.z < constant<Mm<S>>(8.0)) {
    return std::nullopt;
  }
  // Twice the depth leaves the format from 1024 mm on.
  const auto reach = widen<20>(point.z) + widen<20>(point.z);
  if (widen<20>(absolute(point.x)) > reach || widen<20>(absolute(point.y)) > reach) {
    return std::nullopt;
  }
  return Vector2<Ratio<S>>{quotient<Ratio<S>>(point.x, point.z),
                           quotient<Ratio<S>>(point.y, point.z)};
}

/// Camera-frame point to full-frame pixel; empty where to_plane() or the camera model is.
template <Scalar S>
[[nodiscard]] std::optional<Vector2<Px<S>>> to_pixel(const TrackingModel<S>& model,
                                                     const Vector3<Mm<S>>& point);

/// Point of the sheet's plane (mm from the anchor's centre) to full-frame pixel.
template <Scalar S>
[[nodiscard]] std::optional<Vector2<Px<S>>> project(const TrackingModel<S>& model,
                                                    const SheetPose<S>& pose,
                                                    const Vector2<Mm<S>>& local);

/// The point of the sheet's plane (mm from the anchor's centre) that a pixel shows; empty when the
/// ray does not meet the plane in front of the camera within 1500 mm.
template <Scalar S>
[[nodiscard]] std::optional<Vector2<Mm<S>>> to_sheet(const TrackingModel<S>& model,
                                                     const SheetPose<S>& pose,
                                                     const Vector2<Px<S>>& pixel);

}  // namespace tubesight::core::tracking
