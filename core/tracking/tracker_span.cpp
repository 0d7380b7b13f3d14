#include <algorithm>

#include "core/base/instantiate.h"
#include "core/tracking/tracker.h"

// What a tracker makes of the times and numbers of fields.
namespace tubesight::core::tracking {

// Whether fields are missing before this one: numbers are, or time is where the numbers tell
// nothing. The shortest time between two fields is the usual one; stamps that waver by less than
// half of it are no gap.
template <Scalar S>
bool Tracker<S>::misses_fields(const Field& field) {
  if (field.status == FieldStatus::kMissing) {
    order_.miss();
    return true;
  }
  const std::int64_t numbers = field.sequence - seen_sequence_;
  const std::int64_t passed = (field.mid_exposure - seen_time_).count();
  const bool missing = numbers > std::max<std::int64_t>(usual_numbers_, 1) ||
                       (usual_span_ns_ > 0 && passed / 3 > usual_span_ns_ / 2);
  usual_span_ns_ = usual_span_ns_ == 0 ? passed : std::min(usual_span_ns_, passed);
  if (missing) {
    order_.miss();
  }
  return missing;
}

// The time since the last good field, by its stamps or by the lost sequence numbers, whichever is
// longer: the shortest time seen for a number is what each lost one took at least.
template <Scalar S>
FieldTime Tracker<S>::span_since_good(const Field& field) {
  if (field.status == FieldStatus::kMissing) {
    return field.mid_exposure - last_time_;
  }
  constexpr std::int64_t kMany = 1'000'000;
  const std::int64_t lost = std::clamp<std::int64_t>(field.sequence - last_sequence_, 0, kMany);
  const FieldTime told(lost * std::min<std::int64_t>(per_sequence_ns_, 1'000'000'000));
  // Learnt from neighbours alone: a field without a gap before it, whatever its numbers grow by.
  const std::int64_t numbers = field.sequence - seen_sequence_;
  const std::int64_t passed = (field.mid_exposure - seen_time_).count();
  if (numbers > 0 && (usual_numbers_ == 0 || numbers <= usual_numbers_)) {
    const std::int64_t each = passed / numbers;
    const bool first = numbers != usual_numbers_;
    per_sequence_ns_ = first ? each : std::min(per_sequence_ns_, each);
    usual_numbers_ = numbers;
  }
  return std::max(field.mid_exposure - last_time_, told);
}

// What the last velocity's own uncertainty adds to the prediction: the difference of two places
// over their interval, carried on over the span.
template <Scalar S>
Mm<S> Tracker<S>::velocity_deviation_mm(Unit<S> span_s) const {
  using M = Mm<S>;
  if (!motion_.known) {
    return {};
  }
  const M most = from_scaled<M>(32, 0);
  const M ratio = motion_.interval_s < times(span_s, from_scaled<Unit<S>>(1, 5))
                      ? most
                      : quotient<M>(convert<M>(span_s), convert<M>(motion_.interval_s));
  const M root_two = from_scaled<M>(1449, 10);
  return times(times(std::min(picture_deviation_mm_, most), root_two), std::min(ratio, most));
}

#define TUBESIGHT_INSTANTIATE(S)                                \
  template bool Tracker<S>::misses_fields(const Field&);        \
  template FieldTime Tracker<S>::span_since_good(const Field&); \
  template Mm<S> Tracker<S>::velocity_deviation_mm(Unit<S>) const;
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
