#include "core/tracking/tool_gate.h"

#include <algorithm>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/plane_length.h"
#include "core/tracking/sheet_observer.h"

namespace tubesight::core::tracking {
namespace {

// What a normal error exceeds once in 370.
template <typename M>
M three(M deviation) {
  return deviation + deviation + deviation;
}

}  // namespace

template <Scalar S>
void ToolGate<S>::open(const Motion<S>& motion, Unit<S> span_s, bool contradicted) {
  predicted_deviation_mm_ =
      deviation_mm_ + velocity_deviation_mm<S>(motion, picture_deviation_mm_, span_s);
  reach_mm_ = reachable_mm<S>(*model_, motion, span_s, predicted_deviation_mm_);
  if (!contradicted) {
    undisputed_mm_ = reach_mm_;
  }
}

template <Scalar S>
bool ToolGate<S>::exceeds_limit() const {
  const Mm<S> all =
      reach_mm_ + predicted_deviation_mm_ + predicted_deviation_mm_ + predicted_deviation_mm_;
  return all > address_limit_mm<S>(*model_);
}

template <Scalar S>
Reason ToolGate<S>::why_exceeded() const {
  const Mm<S> least = three(systematic_deviation_mm<Mm<S>>());
  return reach_mm_ + least > address_limit_mm<S>(*model_) ? Reason::kRate : Reason::kUncertain;
}

template <Scalar S>
Reason ToolGate<S>::refuses(const Vector2<Mm<S>>& seen, Mm<S> deviation_mm, bool halved,
                            const Vector2<Mm<S>>& expected, const Vector2<Mm<S>>& last,
                            Unit<S> span_s) const {
  using M = Mm<S>;
  const M noise = three(deviation_mm);
  const M reach = halved ? times(believed_mm(), constant<M>(0.5)) : believed_mm();
  // |seen - expected| > reach + 3 sigma
  if (plane_length(seen - expected) > reach + noise) {
    return Reason::kJump;
  }
  // |seen - last| > 1.25 v dt + 3 sigma. A quarter above the limit: the robot's own control may
  // overshoot, the box's noise adds to it.
  const M farthest = times(model_->max_speed_mm_s, span_s);
  if (plane_length(seen - last) > farthest + times(farthest, constant<M>(0.25)) + noise) {
    return Reason::kSpeed;
  }
  return Reason::kNone;
}

template <Scalar S>
void ToolGate<S>::close(Mm<S> deviation_mm, Mm<S> picture_deviation_mm) {
  deviation_mm_ = deviation_mm;
  predicted_deviation_mm_ = deviation_mm;
  picture_deviation_mm_ = picture_deviation_mm;
  strayed_mm_ = {};
}

template <Scalar S>
Mm<S> ToolGate<S>::widest_look_mm() const {
  const Mm<S> reach = address_limit_mm<S>(*model_) - deviation_mm_ - deviation_mm_ - deviation_mm_;
  return std::max(reach, Mm<S>{});
}

TUBESIGHT_INSTANTIATE_CLASS(ToolGate)

}  // namespace tubesight::core::tracking
