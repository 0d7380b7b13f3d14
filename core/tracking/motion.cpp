#include "core/tracking/motion.h"

#include <algorithm>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"

namespace tubesight::core::tracking {

template <Scalar S>
Unit<S> seconds(FieldTime span) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t bounded = std::clamp<std::int64_t>(span.count(), 0, kSecond);
  return from_scaled<Unit<S>>(divide_rounded(bounded << 30, kSecond), 30);
}

template <Scalar S>
Rest rest_of(const Motion<S>& motion, Parity parity) {
  using M = Mm<S>;
  const bool whole = parity == Parity::kProgressive;
  const M approach_mm_s = whole ? motion.approach_mm_s : motion.mean_approach_mm_s;
  const auto within = [&](M approach, M turned) {
    const auto& turn = motion.turn_rad_s;
    return absolute(approach_mm_s) < approach && absolute(turn.x) < turned &&
           absolute(turn.y) < turned && absolute(turn.z) < turned;
  };
  const M fastest = M(kRest_mm_s);
  // Four times as fast from field to field is a tool that goes to and fro.
  if (!motion.known || plane_length(motion.velocity_mm_s) >= M(4 * kRest_mm_s) ||
      plane_length(whole ? motion.velocity_mm_s : motion.mean_velocity_mm_s) >= fastest) {
    return Rest::kNone;
  }
  if (within(fastest, constant<M>(0.035))) {
    return Rest::kStill;
  }
  return within(constant<M>(10.0), constant<M>(0.12)) ? Rest::kNearly : Rest::kNone;
}

template <Scalar S>
bool travels(const Motion<S>& motion) {
  return motion.known && plane_length(motion.velocity_mm_s) > constant<Mm<S>>(30.0);
}

// Each rate times the span: axes turned by w dt, the tool point moved by v dt over the sheet and
// its height by its own rate.
template <Scalar S>
SheetPose<S> predict(const TrackingModel<S>& model, const SheetPose<S>& pose,
                     const ToolPoint<S>& tool, const Motion<S>& motion, Unit<S> span_s) {
  SheetPose<S> predicted = pose;
  if (!motion.known) {
    return predicted;
  }
  using M = Mm<S>;
  const auto during = [span_s](M rate) { return times(rate, span_s); };
  move<S>(predicted,
          {during(motion.turn_rad_s.x), during(motion.turn_rad_s.y), during(motion.turn_rad_s.z)},
          {});
  const auto turned = find_tool_point<S>(model, predicted);
  if (!turned) {
    return pose;
  }
  // The turn was about the anchor; the tool point is put where its own motion takes it.
  const Vector2<M> target{tool.local.x + during(motion.velocity_mm_s.x),
                          tool.local.y + during(motion.velocity_mm_s.y)};
  const M rise = tool.height_mm + during(motion.approach_mm_s) - turned->height_mm;
  const Vector3<M> over = predicted.along(turned->local - target);
  predicted.origin = predicted.origin + over +
                     Vector3<M>{times(rise, predicted.normal.x), times(rise, predicted.normal.y),
                                times(rise, predicted.normal.z)};
  return predicted;
}

template <Scalar S>
Mm<S> address_limit_mm(const TrackingModel<S>& model) {
  return times(model.lattice.parameters().shortest_step, constant<Mm<S>>(0.4));
}

// a span (span + interval) / 2, and at most twice the greatest speed's way.
template <Scalar S>
Mm<S> reachable_mm(const TrackingModel<S>& model, const Motion<S>& motion, Unit<S> span_s,
                   Mm<S> deviation_mm) {
  using M = Mm<S>;
  const M milliseconds = times(constant<M>(1000.0), span_s);
  const M farthest = times(model.max_speed_mm_s, span_s);
  const M interval_ms = motion.known ? times(constant<M>(1000.0), motion.interval_s) : M{};
  // mm = m/s^2 s ms. A change of speed by 2 m/s is beyond any limit and still within the format.
  const M change =
      std::min(times(model.max_acceleration_m_s2, convert<M>(span_s)), constant<M>(2.0));
  const M grown = times(change, times(milliseconds + interval_ms, constant<M>(0.5)));
  if (motion.known) {
    return std::min(grown, farthest + farthest);
  }
  // Two places are compared, each known to three standard deviations: six of them, a sixteenth of
  // the step at least.
  const M step = model.lattice.parameters().shortest_step;
  const M three = deviation_mm + deviation_mm + deviation_mm;
  const M slack = std::max(times(step, constant<M>(1.0 / 16.0)), three + three);
  const M unique = step - farthest - slack;
  // A micrometre under the limit: floating point rounds the sum that is compared with it.
  const M allowed = address_limit_mm<S>(model) - three - constant<M>(0.001);
  const M widest = std::min(times(step, constant<M>(0.375)), allowed);
  return std::min(farthest, std::max(std::min(widest, unique), grown));
}

// sqrt(2) sigma span / interval; neither factor beyond 32, where the track is lost anyway.
template <Scalar S>
Mm<S> velocity_deviation_mm(const Motion<S>& motion, Mm<S> place_mm, Unit<S> span_s) {
  using M = Mm<S>;
  if (!motion.known) {
    return {};
  }
  const M most = constant<M>(32.0);
  const M ratio = motion.interval_s < times(span_s, constant<Unit<S>>(1.0 / 32.0))
                      ? most
                      : quotient<M>(convert<M>(span_s), convert<M>(motion.interval_s));
  const M root_two = constant<M>(1.415);  // rounded up
  return times(times(std::min(place_mm, most), root_two), std::min(ratio, most));
}

// A small turn w takes each axis e to e' = e + w x e. Over three axes at right angles the sum of
// e x e' = w - e (e . w) is 3 w - w, so w is half of it.
template <Scalar S>
Vector3<Mm<S>> turn_between(const SheetPose<S>& before, const SheetPose<S>& after) {
  using M = Mm<S>;
  const auto twice = cross<M>(before.x_axis, after.x_axis) + cross<M>(before.y_axis, after.y_axis) +
                     cross<M>(before.normal, after.normal);
  const M half = constant<M>(0.5);
  return {times(twice.x, half), times(twice.y, half), times(twice.z, half)};
}

template <Scalar S>
Motion<S> motion_between(const SheetPose<S>& before, const ToolPoint<S>& tool_before,
                         const SheetPose<S>& after, const ToolPoint<S>& tool_after,
                         const Motion<S>& last, Unit<S> span_s) {
  using M = Mm<S>;
  Motion<S> motion;
  if (span_s < constant<Unit<S>>(0.001)) {  // under a millisecond no rate can be told
    return last;
  }
  motion.known = true;
  motion.interval_s = span_s;
  const M span = convert<M>(span_s);
  const auto rate = [span](M distance) { return quotient<M>(distance, span); };
  const auto moved = tool_after.local - tool_before.local;
  motion.velocity_mm_s = {rate(moved.x), rate(moved.y)};
  motion.approach_mm_s = rate(tool_after.height_mm - tool_before.height_mm);
  const auto mean = [&last](M now, M earlier) {
    return last.known ? times(now, constant<M>(0.5)) + times(earlier, constant<M>(0.5)) : now;
  };
  motion.mean_velocity_mm_s = {mean(motion.velocity_mm_s.x, last.velocity_mm_s.x),
                               mean(motion.velocity_mm_s.y, last.velocity_mm_s.y)};
  motion.mean_approach_mm_s = mean(motion.approach_mm_s, last.approach_mm_s);
  const auto turn = turn_between<S>(before, after);
  const M half = constant<M>(0.5);
  const auto smoothed = [&](M turned, M rate_before) {
    const M now = times(rate(turned), half);
    return last.known ? now + times(rate_before, half) : now;
  };
  motion.turn_rad_s = {smoothed(turn.x, last.turn_rad_s.x), smoothed(turn.y, last.turn_rad_s.y),
                       smoothed(turn.z, last.turn_rad_s.z)};
  return motion;
}

#define TUBESIGHT_INSTANTIATE(S)                                                                   \
  template Unit<S> seconds<S>(FieldTime);                                                          \
  template Rest rest_of<S>(const Motion<S>&, Parity);                                              \
  template bool travels<S>(const Motion<S>&);                                                      \
  template SheetPose<S> predict<S>(const TrackingModel<S>&, const SheetPose<S>&,                   \
                                   const ToolPoint<S>&, const Motion<S>&, Unit<S>);                \
  template Mm<S> reachable_mm<S>(const TrackingModel<S>&, const Motion<S>&, Unit<S>, Mm<S>);       \
  template Mm<S> address_limit_mm<S>(const TrackingModel<S>&);                                     \
  template Mm<S> velocity_deviation_mm<S>(const Motion<S>&, Mm<S>, Unit<S>);                       \
  template Vector3<Mm<S>> turn_between<S>(const SheetPose<S>&, const SheetPose<S>&);               \
  template Motion<S> motion_between<S>(const SheetPose<S>&, const ToolPoint<S>&,                   \
                                       const SheetPose<S>&, const ToolPoint<S>&, const Motion<S>&, \
                                       Unit<S>);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
