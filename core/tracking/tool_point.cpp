#include "core/tracking/tool_point.h"

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/pose_fit.h"
#include "core/tracking/projection.h"

namespace tubesight::core::tracking {

// The axis tip + s a meets the plane n . (P - origin) = 0 at s = h / (n . a), where
// h = n . (origin - tip) is the tip's distance from the plane.
template <Scalar S>
std::optional<ToolPoint<S>> find_tool_point(const TrackingModel<S>& model,
                                            const SheetPose<S>& pose) {
  using M = Mm<S>;
  const auto& axis = model.virtual_plane.normal();
  const M slope = narrow<M>(dot(pose.normal, axis));
  if (slope < constant<M>(0.90625)) {  // cos 25 degrees
    return std::nullopt;
  }
  ToolPoint<S> tool;
  tool.height_mm = narrow<M>(dot(pose.normal, pose.origin - model.tip_mm));
  const M reach = quotient<M>(tool.height_mm, slope);
  tool.point =
      model.tip_mm + Vector3<M>{times(reach, axis.x), times(reach, axis.y), times(reach, axis.z)};
  const Vector3<M> d = tool.point - pose.origin;
  tool.local = {narrow<M>(dot(pose.x_axis, d)), narrow<M>(dot(pose.y_axis, d))};
  return tool;
}

template <Scalar S>
Mm<S> tool_point_deviation(const SheetPose<S>& pose, const ToolPoint<S>& tool,
                           const NormalEquations<S>& equations) {
  using M = Mm<S>;
  // A turn w moves the sheet at the tool point by w x d, a shift t by t; both move the point the
  // other way over the sheet: along an axis e of it by -e . (w x d + t) = -((d x e) . w + e . t).
  const Vector3<M> d = tool.point - pose.origin;
  const M per_unknown = constant<M>(1.0 / 128.0);
  const auto deviation = [&](const Vector3<Unit<S>>& axis) {
    const Vector3<M> lever = cross<M>(d, axis);
    return equations.deviation({times(lever.x, per_unknown), times(lever.y, per_unknown),
                                times(lever.z, per_unknown), convert<M>(axis.x), convert<M>(axis.y),
                                convert<M>(axis.z)});
  };
  // Bounded: a hundred millimetres and a thousand are the same "unknown", and squares must fit.
  const M limit = constant<M>(30.0);
  const auto bounded = [limit](M value) { return value < limit ? value : limit; };
  const M x = bounded(deviation(pose.x_axis));
  const M y = bounded(deviation(pose.y_axis));
  return times(square_root(times(x, x) + times(y, y)), from_scaled<M>(kEdgeDeviationQ10, 10));
}

// On the image plane at unit distance: p the site, t the tip, and d the unit vector from t along
// the guidetube. Half of a bore's inside, which is looked at, is hidden where the site is not
// farther beside the line than half the thickest guidetube and that half, and not as far before its
// end: a disc across the axis, and so the shorter the more of its side is seen.
template <Scalar S>
bool clear_of_guidetube(const TrackingModel<S>& model, const SheetPose<S>& pose,
                        TubeAddress address) {
  using M = Mm<S>;
  const auto on_plane = [](const Vector3<M>& point) -> std::optional<Vector2<M>> {
    const auto plane = to_plane<S>(point);
    return plane ? std::optional(Vector2<M>{convert<M>(plane->x), convert<M>(plane->y)})
                 : std::nullopt;
  };
  const auto& axis = model.virtual_plane.normal();
  const M back = constant<M>(-16.0);  // mm along the guidetube
  const auto tip = on_plane(model.tip_mm);
  const auto behind = on_plane(
      model.tip_mm + Vector3<M>{times(back, axis.x), times(back, axis.y), times(back, axis.z)});
  const auto site = on_plane(pose.origin + pose.along(model.lattice.offset(pose.anchor, address)));
  if (!tip || !behind || !site) {
    return false;
  }
  const Vector2<M> along = *behind - *tip;
  const M length = plane_length(along);
  if (length < constant<M>(0.01)) {
    return false;
  }
  const M half = times(model.lattice.parameters().shortest_step, constant<M>(0.5));
  const M looked_at = times(model.bore_radius_mm, constant<M>(0.5));
  const M thick = quotient<M>(half + looked_at, model.tip_mm.z);
  const M before_end = times(thick, absolute(axis.z));
  const Vector2<M> from_tip = *site - *tip;
  const M forward =
      quotient<M>(narrow<M>(product(from_tip.x, along.x) + product(from_tip.y, along.y)), length);
  const M aside =
      quotient<M>(narrow<M>(product(from_tip.x, along.y) - product(from_tip.y, along.x)), length);
  return forward < -before_end || absolute(aside) > thick;
}

#define TUBESIGHT_INSTANTIATE(S)                                                   \
  template std::optional<ToolPoint<S>> find_tool_point<S>(const TrackingModel<S>&, \
                                                          const SheetPose<S>&);    \
  template Mm<S> tool_point_deviation<S>(const SheetPose<S>&, const ToolPoint<S>&, \
                                         const NormalEquations<S>&);               \
  template bool clear_of_guidetube<S>(const TrackingModel<S>&, const SheetPose<S>&, TubeAddress);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
