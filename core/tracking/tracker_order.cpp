#include <algorithm>

#include "core/base/instantiate.h"
#include "core/base/overflow.h"
#include "core/tracking/tracker.h"

// How a tracker finds out that a frame's fields come in another order than the settings say.
namespace tubesight::core::tracking {

// Tells the judge of the order where this field shows the tool.
template <Scalar S>
void Tracker<S>::note_place(const Field& field, const Vector2<Mm<S>>& local) {
  aside_known_ = false;
  if (model_->first_field == Parity::kProgressive) {
    return;
  }
  order_.take({to_scaled(local.x, 10), to_scaled(local.y, 10)},
              field.parity == model_->first_field);
}

// A picture that refutes the prediction is looked at once more, as far around the last place as a
// tube-end cannot be mistaken for its neighbour. Nothing is believed of it; it only serves to name
// the reason if the track is lost.
template <Scalar S>
void Tracker<S>::look_aside(const Field& field) {
  if (model_->first_field == Parity::kProgressive || !motion_.known) {
    return;
  }
  if (!doubt_.contradicted()) {
    aside_ = pose_;
    aside_known_ = true;
  }
  if (!aside_known_) {
    return;
  }
  const bool overflowed = take_overflow_flag();
  const Observation<S> outcome =
      observer_.glance(field.pixels, {aside_, gate_.widest_look_mm(), motion_.known});
  const bool overflowed_aside = take_overflow_flag();
  if (overflowed) {
    raise_overflow_flag();
  }
  aside_known_ = !overflowed_aside && outcome.fitted && !outcome.contradiction;
  if (!aside_known_) {
    order_.miss();
    return;
  }
  aside_ = outcome.pose;
  order_.take({to_scaled(outcome.tool.local.x, 10), to_scaled(outcome.tool.local.y, 10)},
              field.parity == model_->first_field);
}

// Whether the places that refute the prediction make a motion in another order.
template <Scalar S>
bool Tracker<S>::order_explains() const {
  // mm a field and field, in 1/1024: m/s^2 times us^2 are 1e-9 mm.
  const std::int64_t field_us = clock_.usual_span_ns() / 1000;
  const std::int64_t change =
      std::int64_t{to_scaled(model_->max_acceleration_m_s2, 10)} * field_us * field_us;
  return order_.wrong() || order_.explains(static_cast<std::int32_t>(change / 1'000'000'000));
}

#define TUBESIGHT_INSTANTIATE(S)                                             \
  template void Tracker<S>::note_place(const Field&, const Vector2<Mm<S>>&); \
  template void Tracker<S>::look_aside(const Field&);                        \
  template bool Tracker<S>::order_explains() const;
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
