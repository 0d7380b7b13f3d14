#include "core/camera/virtual_plane.h"

#include "core/base/constant.h"
#include "core/base/instantiate.h"

namespace tubesight::core::camera {

template <Scalar S>
std::optional<Vector2<Mm<S>>> VirtualPlane<S>::from_image(const Vector2<Ratio<S>>& point) const {
  using R = Ratio<S>;
  // No component of a ray within the domain exceeds its length, sqrt(1 + 2 * 1.8^2) = 2.7.
  const Vector3<R> ray{point.x, point.y, R(1)};
  const R depth = narrow<R>(dot(ray, normal_));
  if (depth < constant<R>(0.125)) {
    return std::nullopt;
  }
  return Vector2<Mm<S>>{quotient<Mm<S>>(narrow<R>(dot(ray, x_axis_)), depth),
                        quotient<Mm<S>>(narrow<R>(dot(ray, y_axis_)), depth)};
}

template <Scalar S>
std::optional<Vector2<Ratio<S>>> VirtualPlane<S>::to_image(const Vector2<Mm<S>>& point) const {
  const auto along = [&point](Unit<S> x, Unit<S> y, Unit<S> n) {
    return narrow<Mm<S>>(product(x, point.x) + product(y, point.y) + product(n, Mm<S>(1)));
  };
  const Vector3<Mm<S>> ray{along(x_axis_.x, y_axis_.x, normal_.x),
                           along(x_axis_.y, y_axis_.y, normal_.y),
                           along(x_axis_.z, y_axis_.z, normal_.z)};
  const Mm<S> reach = times(ray.z, constant<Mm<S>>(1.8));
  if (ray.z < constant<Mm<S>>(0.125) || absolute(ray.x) > reach || absolute(ray.y) > reach) {
    return std::nullopt;
  }
  return Vector2<Ratio<S>>{quotient<Ratio<S>>(ray.x, ray.z), quotient<Ratio<S>>(ray.y, ray.z)};
}

TUBESIGHT_INSTANTIATE_CLASS(VirtualPlane)

}  // namespace tubesight::core::camera
