#include "core/tracking/field_clock.h"

#include <algorithm>

namespace tubesight::core::tracking {

void FieldClock::begin() {
  usual_numbers_ = 0;
  per_sequence_ns_ = 0;
  usual_span_ns_ = 0;
}

Reason FieldClock::refuses(const Field& field) const {
  if (field.mid_exposure <= seen_time_) {
    return Reason::kTime;
  }
  const bool numbered = field.status != FieldStatus::kMissing;
  return numbered && field.sequence < seen_sequence_ ? Reason::kSequence : Reason::kNone;
}

FieldClock::Passed FieldClock::pass(const Field& field) {
  if (field.status == FieldStatus::kMissing) {
    return {true, stamped_since_good(field)};
  }
  const bool missing = misses_fields(field);
  return {missing, since_good(field)};
}

// Numbers are missing, or time is where the numbers tell nothing. The shortest time between two
// fields is the usual one; stamps that waver by less than half of it are no gap.
bool FieldClock::misses_fields(const Field& field) {
  const std::int64_t numbers = field.sequence - seen_sequence_;
  const std::int64_t passed = (field.mid_exposure - seen_time_).count();
  // passed > 1.5 usual spans, without a product that could overflow.
  const bool missing = numbers > std::max<std::int64_t>(usual_numbers_, 1) ||
                       (usual_span_ns_ > 0 && passed / 3 > usual_span_ns_ / 2);
  usual_span_ns_ = usual_span_ns_ == 0 ? passed : std::min(usual_span_ns_, passed);
  return missing;
}

// By the stamps or by the lost sequence numbers, whichever is longer: the shortest time seen for a
// number is what each lost one took at least.
FieldTime FieldClock::since_good(const Field& field) {
  constexpr std::int64_t kMany = 1'000'000;
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const std::int64_t lost = std::clamp<std::int64_t>(field.sequence - good_sequence_, 0, kMany);
  const FieldTime told(lost * std::min(per_sequence_ns_, kSecond_ns));
  // Learnt from neighbours alone: a field without a gap before it, whatever its numbers grow by.
  const std::int64_t numbers = field.sequence - seen_sequence_;
  const std::int64_t passed = (field.mid_exposure - seen_time_).count();
  if (numbers > 0 && (usual_numbers_ == 0 || numbers <= usual_numbers_)) {
    const std::int64_t each = passed / numbers;
    const bool first = numbers != usual_numbers_;
    per_sequence_ns_ = first ? each : std::min(per_sequence_ns_, each);
    usual_numbers_ = numbers;
  }
  return std::max(stamped_since_good(field), told);
}

void FieldClock::believe(const Field& field) {
  good_time_ = field.mid_exposure;
  good_sequence_ = field.sequence;
}

void FieldClock::see(const Field& field) {
  if (field.status != FieldStatus::kMissing) {
    seen_time_ = field.mid_exposure;
    seen_sequence_ = field.sequence;
  }
}

}  // namespace tubesight::core::tracking
