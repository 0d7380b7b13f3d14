#pragma once

#include <optional>

#include "core/base/scalar.h"
#include "core/base/vector3.h"

namespace tubesight::core::camera {

/// The rotated virtual image plane: the picture as a camera would see it that looks along the
/// guidetube, in which a level tubesheet is only shifted, turned and scaled [Fallon eq. 6.3-6.14].
///
/// The source lays the plane through (0, 0, EFL); here it stands at unit distance from the
/// projection point along the normal, which differs by the factor N_2 EFL alone, and points on it
/// are written in the tool's x and y directions. Image-plane points are those of CameraModel, 1.8
/// from the axis at most; points of the plane reach to 1000.
///
/// Worst errors, from_image and to_image, as numbers of the plane at unit distance (times some 500
/// are pixels): double 1e-14 both; float 8e-6 (2e-6 where the depth is 0.3 or more) and 5e-7; fixed
/// point 6e-7 and 1.5e-6.
template <Scalar S>
class VirtualPlane {
 public:
  VirtualPlane() = default;
  /// `x_axis`, `y_axis`, `normal`: the tool's axes in the camera frame, orthonormal; the normal is
  /// the source's N.
  VirtualPlane(const Vector3<Unit<S>>& x_axis, const Vector3<Unit<S>>& y_axis,
               const Vector3<Unit<S>>& normal)
      : x_axis_(x_axis), y_axis_(y_axis), normal_(normal) {}

  /// Image plane to virtual plane [Fallon eq. 6.8-6.10]. Empty when the ray (x, y, 1) runs along
  /// the plane or away from it: its depth along the normal is below 1/8.
  [[nodiscard]] std::optional<Vector2<Mm<S>>> from_image(const Vector2<Ratio<S>>& point) const;

  /// Virtual plane to image plane [Fallon eq. 6.12-6.14]. Empty when the point lies beside or
  /// behind the camera, or over 60 degrees off its axis.
  [[nodiscard]] std::optional<Vector2<Ratio<S>>> to_image(const Vector2<Mm<S>>& point) const;

  [[nodiscard]] const Vector3<Unit<S>>& x_axis() const { return x_axis_; }
  [[nodiscard]] const Vector3<Unit<S>>& y_axis() const { return y_axis_; }
  [[nodiscard]] const Vector3<Unit<S>>& normal() const { return normal_; }

 private:
  Vector3<Unit<S>> x_axis_{};
  Vector3<Unit<S>> y_axis_{};
  Vector3<Unit<S>> normal_{};
};

}  // namespace tubesight::core::camera
