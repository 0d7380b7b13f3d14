#include "core/tracking/projection.h"

#include "core/base/constant.h"
#include "core/base/instantiate.h"

namespace tubesight::core::tracking {
namespace {

// Whether a product, or a difference, is larger than so many millimetres, which its own format may
// not hold.
template <typename M, typename R>
bool beyond(M depth, R share, std::int32_t most_mm) {
  return product(depth, absolute(share)) > product(from_scaled<M>(most_mm, 0), R(1));
}
template <typename M>
bool apart(M a, M b, std::int32_t most_mm) {
  const auto off = widen<20>(a) - widen<20>(b);
  const auto most = widen<20>(from_scaled<M>(most_mm, 0));
  return off > most || -off > most;
}

}  // namespace

template <Scalar S>
std::optional<Vector2<Px<S>>> to_pixel(const TrackingModel<S>& model, const Vector3<Mm<S>>& point) {
  const auto plane = to_plane<S>(point);
  return plane ? model.camera.to_pixel(*plane) : std::nullopt;
}

template <Scalar S>
std::optional<Vector2<Px<S>>> project(const TrackingModel<S>& model, const SheetPose<S>& pose,
                                      const Vector2<Mm<S>>& local) {
  return to_pixel<S>(model, pose.origin + pose.along(local));
}

// The ray z (x, y, 1) meets the plane n . (P - origin) = 0 at the depth z = n . origin / n . (x, y,
// 1).
template <Scalar S>
std::optional<Vector2<Mm<S>>> to_sheet(const TrackingModel<S>& model, const SheetPose<S>& pose,
                                       const Vector2<Px<S>>& pixel) {
  const auto plane = model.camera.to_plane(pixel);
  const Vector3<Ratio<S>> ray{plane.x, plane.y, Ratio<S>(1)};
  const Mm<S> slope = narrow<Mm<S>>(dot(ray, pose.normal));
  const Mm<S> distance = narrow<Mm<S>>(dot(pose.normal, pose.origin));
  // Depths beyond 1500 mm are refused before the division can leave the format.
  if (slope < constant<Mm<S>>(1.0 / 32.0) || distance < Mm<S>{} ||
      product(distance, Mm<S>(1)) > product(slope, constant<Mm<S>>(1500.0))) {
    return std::nullopt;
  }
  const Mm<S> depth = quotient<Mm<S>>(distance, slope);
  // So is what looks past 1900 mm aside, or lies 1180 mm from the anchor along an axis.
  if (beyond(depth, ray.x, 1900) || beyond(depth, ray.y, 1900)) {
    return std::nullopt;
  }
  const Vector3<Mm<S>> point{times(depth, ray.x), times(depth, ray.y), depth};
  if (apart(point.x, pose.origin.x, 1180) || apart(point.y, pose.origin.y, 1180) ||
      apart(point.z, pose.origin.z, 1180)) {
    return std::nullopt;
  }
  const Vector3<Mm<S>> d = point - pose.origin;
  return Vector2<Mm<S>>{narrow<Mm<S>>(dot(pose.x_axis, d)), narrow<Mm<S>>(dot(pose.y_axis, d))};
}

#define TUBESIGHT_INSTANTIATE(S)                                                                   \
  template std::optional<Vector2<Px<S>>> to_pixel<S>(const TrackingModel<S>&,                      \
                                                     const Vector3<Mm<S>>&);                       \
  template std::optional<Vector2<Px<S>>> project<S>(const TrackingModel<S>&, const SheetPose<S>&,  \
                                                    const Vector2<Mm<S>>&);                        \
  template std::optional<Vector2<Mm<S>>> to_sheet<S>(const TrackingModel<S>&, const SheetPose<S>&, \
                                                     const Vector2<Px<S>>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
