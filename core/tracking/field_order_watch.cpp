#include "core/tracking/field_order_watch.h"

#include "core/base/instantiate.h"

namespace tubesight::core::tracking {

template <Scalar S>
void FieldOrderWatch<S>::begin() {
  order_.begin();
  aside_known_ = false;
}

template <Scalar S>
void FieldOrderWatch<S>::take(const Field& field, const Vector2<Mm<S>>& tool) {
  order_.take({to_scaled(tool.x, 10), to_scaled(tool.y, 10)}, field.parity == model_->first_field);
}

template <Scalar S>
void FieldOrderWatch<S>::believe(const Field& field, const Vector2<Mm<S>>& tool) {
  aside_known_ = false;
  if (has_fields()) {
    take(field, tool);
  }
}

template <Scalar S>
void FieldOrderWatch<S>::look_aside(const Field& field, const SheetPose<S>& last, Mm<S> reach_mm,
                                    bool contradicted, SheetObserver<S>& observer) {
  if (!has_fields()) {
    return;
  }
  if (!contradicted) {
    aside_ = last;
    aside_known_ = true;
  }
  if (!aside_known_) {
    return;
  }
  const Observation<S> seen = observer.glance(field.pixels, {aside_, reach_mm, true});
  aside_known_ = seen.fitted && !seen.contradiction;
  if (!aside_known_) {
    order_.miss();
    return;
  }
  aside_ = seen.pose;
  take(field, seen.tool.local);
}

template <Scalar S>
void FieldOrderWatch<S>::move_anchor(const Vector2<Mm<S>>& by) {
  order_.shift({-to_scaled(by.x, 10), -to_scaled(by.y, 10)});
}

// The greatest change of the way from field to field is a dt^2. In 1/1024 mm: m/s^2 times us^2 are
// 1e-9 mm.
template <Scalar S>
bool FieldOrderWatch<S>::explains(std::int64_t field_ns) const {
  const std::int64_t field_us = field_ns / 1000;
  const std::int64_t change =
      std::int64_t{to_scaled(model_->max_acceleration_m_s2, 10)} * field_us * field_us;
  return order_.wrong() || order_.explains(static_cast<std::int32_t>(change / 1'000'000'000));
}

TUBESIGHT_INSTANTIATE_CLASS(FieldOrderWatch)

}  // namespace tubesight::core::tracking
