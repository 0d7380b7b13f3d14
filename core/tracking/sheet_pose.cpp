#include "core/tracking/sheet_pose.h"

#include "core/base/constant.h"
#include "core/base/instantiate.h"

namespace tubesight::core::tracking {
namespace {

template <typename U>
Vector3<U> scaled(const Vector3<U>& v, U factor) {
  return {times(v.x, factor), times(v.y, factor), times(v.z, factor)};
}

// A vector of nearly unit length made one: one step of Newton's method for 1 / sqrt(s) at s = 1:
// 1 + (1 - s) / 2.
template <typename U>
Vector3<U> normalized(const Vector3<U>& v) {
  const U length2 = narrow<U>(dot(v, v));
  const U factor = U(1) + (constant<U>(0.5) - times(length2, constant<U>(0.5)));
  return scaled(v, factor);
}

// v + w x v + w x (w x v) / 2 [the exponential map to second order, then normalised].
template <typename U, typename M>
Vector3<U> turned(const Vector3<U>& v, const Vector3<M>& turn) {
  const Vector3<U> once = cross<U>(turn, v);
  const Vector3<U> twice = cross<U>(turn, once);
  return v + once + scaled(twice, constant<U>(0.5));
}

}  // namespace

template <Scalar S>
void move(SheetPose<S>& pose, const Vector3<Mm<S>>& turn_rad, const Vector3<Mm<S>>& shift_mm) {
  using U = Unit<S>;
  pose.x_axis = normalized(normalized(turned(pose.x_axis, turn_rad)));
  Vector3<U> y = turned(pose.y_axis, turn_rad);
  const U overlap = narrow<U>(dot(pose.x_axis, y));
  y = y - scaled(pose.x_axis, overlap);
  pose.y_axis = normalized(normalized(y));
  pose.normal = cross<U>(pose.x_axis, pose.y_axis);
  pose.origin = pose.origin + shift_mm;
}

#define TUBESIGHT_INSTANTIATE(S) \
  template void move<S>(SheetPose<S>&, const Vector3<Mm<S>>&, const Vector3<Mm<S>>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
