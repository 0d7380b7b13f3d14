#pragma once

#include "core/base/scalar.h"
#include "core/base/tube_address.h"
#include "core/base/vector3.h"

namespace tubesight::core::tracking {

/// Where the tubesheet stands before the camera: T_camera_sheet with the sheet's origin moved to
/// the centre of an anchor tube near the middle of the view, so that numbers stay small.
///
/// Camera frame; the axes are orthonormal to 1e-8.
template <Scalar S>
struct SheetPose {
  TubeAddress anchor{};
  Vector3<Unit<S>> x_axis{};
  Vector3<Unit<S>> y_axis{};
  Vector3<Unit<S>> normal{};
  Vector3<Mm<S>> origin{};  ///< centre of the anchor tube

  /// A vector of the plane, mm, written in the camera frame.
  [[nodiscard]] Vector3<Mm<S>> along(const Vector2<Mm<S>>& plane) const {
    const auto component = [&plane](Unit<S> x, Unit<S> y) {
      return narrow<Mm<S>>(product(x, plane.x) + product(y, plane.y));
    };
    return {component(x_axis.x, y_axis.x), component(x_axis.y, y_axis.y),
            component(x_axis.z, y_axis.z)};
  }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [anchor_tube, x, y, z, place] = self;
    stream(anchor_tube, x, y, z, place);
  }
};

/// Turns the pose by the small rotation vector `turn_rad` (camera frame, about the anchor's centre)
/// and shifts it by `shift_mm`. Exact to the third order; the axes are made orthonormal again.
/// For |turn_rad| up to 0.3.
template <Scalar S>
void move(SheetPose<S>& pose, const Vector3<Mm<S>>& turn_rad, const Vector3<Mm<S>>& shift_mm);

}  // namespace tubesight::core::tracking
