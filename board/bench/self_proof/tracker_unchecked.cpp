#include "core/tracking/tracker.h"

// The tracker without its margin check, which proves that the campaign finds wrong tubes.
namespace tubesight::core::tracking {

// Believes every picture that can be fitted to a lattice, wherever the tool would have gone: what
// follow() does without reach, limit and gate.
template <Scalar S, typename Margin>
void Tracker<S, Margin>::follow_unchecked(const Field& field) {
  const Unit<S> span_s = seconds<S>(clock_.stamped_since_good(field));
  const SheetPose<S> predicted = predict<S>(*model_, good_.pose, good_.tool, motion_, span_s);
  if (field.status != FieldStatus::kGood) {
    coast(Reason::kDamagedField, predicted);
    return;
  }
  const Mm<S> half_step =
      times(model_->lattice.parameters().shortest_step, from_scaled<Mm<S>>(1, 1));
  const Observation<S> seen =
      observer_.observe(field.pixels, {predicted, half_step, motion_.known});
  if (!seen.fitted) {
    coast(seen.trouble, predicted);
    return;
  }
  motion_ = motion_between<S>(good_.pose, good_.tool, seen.pose, seen.tool, motion_, span_s);
  accept(seen, field);
}

template void Tracker<FixedPoint, MarginUnchecked>::follow_unchecked(const Field&);

}  // namespace tubesight::core::tracking
