#include "core/tracking/attitude_gate.h"

#include <algorithm>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"

namespace tubesight::core::tracking {
namespace {

// What is uncertain in one of the three numbers: three deviations of either picture, the last one's
// grown by what the rate between pictures carries on, and what stays even in perfect pictures, as
// other tube-ends come into view.
template <Scalar S>
Mm<S> uncertain(Mm<S> seen, Mm<S> last, Mm<S> ratio, Mm<S> systematic) {
  const Mm<S> all = seen + last + times(last, ratio);
  return all + all + all + systematic;
}

// Whether of one number nothing changes so fast: more than the greatest speed and a quarter.
template <Scalar S>
bool too_fast(Mm<S> changed, Mm<S> speed, Unit<S> span_s, Mm<S> slack) {
  const Mm<S> farthest = times(speed, span_s);
  return changed > farthest + times(farthest, constant<Mm<S>>(0.25)) + slack;
}

// A turn as its parts about the sheet's normal and across it, rad.
template <Scalar S>
struct TurnParts {
  Mm<S> heading{};
  Mm<S> lean{};
};

template <Scalar S>
TurnParts<S> parts_of(const SheetPose<S>& before, const SheetPose<S>& after) {
  const auto turn = turn_between<S>(before, after);
  const auto along = [&turn](const Vector3<Unit<S>>& axis) {
    return narrow<Mm<S>>(dot(axis, turn));
  };
  return {absolute(along(after.normal)),
          plane_length(Vector2<Mm<S>>{along(after.x_axis), along(after.y_axis)})};
}

}  // namespace

template <Scalar S>
bool few_are_left(const Observation<S>& seen, const Observation<S>& last, std::int32_t part) {
  constexpr std::int32_t kFew = 6;  // looked at: a share of so few says nothing
  return seen.looked_at >= kFew && last.looked_at >= kFew &&
         part * seen.fit.used * last.looked_at < last.fit.used * seen.looked_at;
}

template <Scalar S>
Reason refuses_attitude(const TrackingModel<S>& model, const Observation<S>& seen,
                        const SheetPose<S>& predicted, Mm<S> predicted_height_mm,
                        const Observation<S>& last, const Motion<S>& motion, Unit<S> span_s) {
  using M = Mm<S>;
  if (few_are_left<S>(seen, last, 3)) {
    return Reason::kNoTubes;
  }
  const M span = convert<M>(span_s);
  const M interval = motion.known ? convert<M>(motion.interval_s) : M{};
  const bool wide = times(interval, constant<M>(4.0)) < span;
  const M ratio = !motion.known ? M{} : wide ? constant<M>(4.0) : quotient<M>(span, interval);
  const M heading_slack = uncertain<S>(seen.attitude.heading_rad, last.attitude.heading_rad, ratio,
                                       constant<M>(0.004));  // 0.2 degrees
  const M lean_slack = uncertain<S>(seen.attitude.lean_rad, last.attitude.lean_rad, ratio,
                                    constant<M>(0.006));  // 0.3 degrees
  const M height_slack =
      uncertain<S>(seen.attitude.height_mm, last.attitude.height_mm, ratio, constant<M>(0.3));
  const TurnParts<S> turned = parts_of<S>(last.pose, seen.pose);
  const M risen = absolute(seen.tool.height_mm - last.tool.height_mm);
  if (too_fast<S>(turned.heading, model.turn.speed, span_s, heading_slack) ||
      too_fast<S>(turned.lean, model.lean.speed, span_s, lean_slack) ||
      too_fast<S>(risen, model.height.speed, span_s, height_slack)) {
    return Reason::kSpeed;
  }
  if (!motion.known) {
    return Reason::kNone;
  }
  // The height's rate is a mean over the last interval, half an interval old: a t (t + T) / 2. That
  // of a turn is half the last one's and half the one before's: another interval older.
  const M grown = times(times(span + interval, span_s), constant<M>(0.5));
  const M grown_turn =
      times(times(span + interval + interval + interval, span_s), constant<M>(0.5));
  const TurnParts<S> off = parts_of<S>(predicted, seen.pose);
  const M rise_off = absolute(seen.tool.height_mm - predicted_height_mm);
  // Accelerations are in metres, as their millimetres leave the format; spans below a second. A
  // metre is beyond any height and still within the format.
  const M rise_grown_m = std::min(times(model.height.acceleration, grown), M(1));
  const M rise_grown = times(rise_grown_m, constant<M>(1000.0));
  const bool jumped = off.heading > times(model.turn.acceleration, grown_turn) + heading_slack ||
                      off.lean > times(model.lean.acceleration, grown_turn) + lean_slack ||
                      rise_off > rise_grown + height_slack;
  return jumped ? Reason::kJump : Reason::kNone;
}

#define TUBESIGHT_INSTANTIATE(S)                                                             \
  template bool few_are_left<S>(const Observation<S>&, const Observation<S>&, std::int32_t); \
  template Reason refuses_attitude<S>(const TrackingModel<S>&, const Observation<S>&,        \
                                      const SheetPose<S>&, Mm<S>, const Observation<S>&,     \
                                      const Motion<S>&, Unit<S>);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
