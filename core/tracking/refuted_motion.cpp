#include "core/tracking/refuted_motion.h"

#include <algorithm>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/motion.h"
#include "core/tracking/plane_length.h"

namespace tubesight::core::tracking {

// Lattice steps do not count; a shift of the anchor, which is one, neither.
template <Scalar S>
Vector2<Mm<S>> RefutedMotion<S>::to_nearest(TubeAddress anchor, const Vector2<Mm<S>>& way) const {
  return way - model_->lattice.offset(anchor, model_->lattice.nearest(anchor, way));
}

// Whether a picture can follow the ones before within the limits: of one, by the greatest speed and
// a quarter; of two, that go on as they moved, by the acceleration: a t (t + interval) / 2. What
// two pictures explain must lie clearly nearer to them than to the track, or it is no explanation.
template <Scalar S>
bool RefutedMotion<S>::continues(const PlaceSeen<S>& seen, Unit<S> span_s,
                                 Vector2<Mm<S>>& way) const {
  using M = Mm<S>;
  const M noise = seen.deviation_mm + seen.deviation_mm + seen.deviation_mm;
  const M span = convert<M>(span_s);
  way = to_nearest(seen.anchor, seen.local - at_);
  if (pictures_ < 2) {
    const M farthest = times(model_->max_speed_mm_s, span_s);
    return plane_length(way) <= farthest + times(farthest, constant<M>(0.25)) + noise;
  }
  const M interval = convert<M>(interval_s_);
  const M ratio = quotient<M>(span, interval);
  const Vector2<M> expected{times(way_.x, ratio), times(way_.y, ratio)};
  const M off = plane_length(to_nearest(seen.anchor, way - expected));
  // mm = m/s^2 s ms.
  const M reach = times(times(model_->max_acceleration_m_s2, span_s),
                        times(span + interval, constant<M>(500.0)));
  return off <= std::min(reach + noise, times(off_mm_, constant<M>(0.5)));
}

// Follows the motion to a picture, or begins another there.
template <Scalar S>
void RefutedMotion<S>::take(const Field& field, const PlaceSeen<S>& seen) {
  using U = Unit<S>;
  const U span_s = seconds<S>(field.mid_exposure - time_);
  // Between neighbouring fields, give or take: others say nothing of each other.
  const bool near = pictures_ > 0 && span_s > constant<U>(0.001) && span_s < constant<U>(0.125) &&
                    (pictures_ < 2 || times(span_s, constant<U>(0.25)) < interval_s_);
  Vector2<Mm<S>> way{};
  if (near && continues(seen, span_s, way)) {
    pictures_ = std::min(pictures_ + 1, kOneMotion);
    way_ = way;
    interval_s_ = span_s;
  } else {
    pictures_ = 1;
  }
  at_ = seen.local;
  time_ = field.mid_exposure;
}

template <Scalar S>
bool RefutedMotion<S>::refute(const Field& field, const PlaceSeen<S>& seen,
                              const PlaceExpected<S>& expected) {
  using M = Mm<S>;
  take(field, seen);
  const Vector2<M> off = seen.local - expected.local;
  off_mm_ = plane_length(to_nearest(seen.anchor, off));
  // A tenth of the lattice step beyond what the gate forgives.
  const M clear = expected.reach_mm + seen.deviation_mm + seen.deviation_mm + seen.deviation_mm +
                  times(model_->lattice.parameters().shortest_step, constant<M>(0.1));
  bool elsewhere = true;
  constexpr std::int32_t kBack = 3;
  constexpr std::int32_t kAhead = 2;
  for (std::int32_t fields = -kBack; fields <= kAhead && elsewhere; ++fields) {
    const M count = from_scaled<M>(fields, 0);
    const Vector2<M> moved{times(expected.a_field_mm.x, count),
                           times(expected.a_field_mm.y, count)};
    elsewhere = plane_length(to_nearest(seen.anchor, off - moved)) > clear;
  }
  return elsewhere || pictures_ == kOneMotion;
}

template <Scalar S>
bool RefutedMotion<S>::come_back(const Field& field, const PlaceSeen<S>& seen) {
  if (pictures_ == 0) {
    return false;
  }
  const std::int32_t before = pictures_;
  take(field, seen);
  if (pictures_ <= before) {
    pictures_ = 0;  // they lead elsewhere
  }
  return pictures_ == kOneMotion;
}

TUBESIGHT_INSTANTIATE_CLASS(RefutedMotion)

}  // namespace tubesight::core::tracking
