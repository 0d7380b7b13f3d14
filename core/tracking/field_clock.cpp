#include "core/tracking/field_clock.h"

#include <algorithm>

namespace tubesight::core::tracking {

void FieldClock::begin() {
  usual_numbers_ = 0;
  per_sequence_ns_ = 0;
  usual_span_ns_ = 0;
  stamp_ = FieldCadence::Stamp::kAlone;
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
  stamp_ = cadence_.judge(field.mid_exposure, numbers_since_seen(field));
  even_ = even_ && stamp_ != FieldCadence::Stamp::kAlone;
  const bool missing = misses_fields(field);
  return {missing, since_good(field)};
}

// Since the last field: by its number where the stamp wavers beside it.
std::int64_t FieldClock::passed_ns(const Field& field) const {
  return stamp_ == FieldCadence::Stamp::kWavers
             ? cadence_.time_of(numbers_since_seen(field)).count()
             : (field.mid_exposure - seen_time_).count();
}

// Numbers are missing, or time is where the numbers tell nothing. The shortest time between two
// fields is the usual one; stamps that waver by less than half of it are no gap.
bool FieldClock::misses_fields(const Field& field) {
  const std::int64_t numbers = numbers_since_seen(field);
  const std::int64_t passed = passed_ns(field);
  // passed > 1.5 usual spans, without a product that could overflow.
  const bool missing = numbers > std::max<std::int64_t>(usual_numbers_, 1) ||
                       (usual_span_ns_ > 0 && passed / 3 > usual_span_ns_ / 2);
  if (stamp_ == FieldCadence::Stamp::kWavers) {
    // A shortest time among wavering stamps is none that a field took.
    usual_span_ns_ = passed / std::max<std::int64_t>(numbers / cadence_.step(), 1);
    return numbers > cadence_.step();
  }
  usual_span_ns_ = usual_span_ns_ == 0 ? passed : std::min(usual_span_ns_, passed);
  return missing;
}

// By the numbers alone where stamps waver beside them. Else by the stamps or by the lost sequence
// numbers, whichever is longer: the shortest time seen for a number is what each lost one took at
// least.
FieldTime FieldClock::since_good(const Field& field) {
  constexpr std::int64_t kMany = 1'000'000;
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const std::int64_t lost = std::clamp<std::int64_t>(field.sequence - good_sequence_, 0, kMany);
  const FieldTime told(lost * std::min(per_sequence_ns_, kSecond_ns));
  // Learnt from neighbours alone: a field without a gap before it, whatever its numbers grow by.
  const std::int64_t numbers = numbers_since_seen(field);
  const std::int64_t passed = passed_ns(field);
  if (numbers > 0 && (usual_numbers_ == 0 || numbers <= usual_numbers_)) {
    const std::int64_t each = passed / numbers;
    const bool first = numbers != usual_numbers_;
    per_sequence_ns_ = first ? each : std::min(per_sequence_ns_, each);
    usual_numbers_ = numbers;
  }
  const bool wavers = stamp_ == FieldCadence::Stamp::kWavers || good_wavers_;
  if (even_ && wavers && lost > 0) {
    return cadence_.time_of(lost);
  }
  return std::max(stamped_since_good(field), told);
}

void FieldClock::believe(const Field& field) {
  good_time_ = field.mid_exposure;
  good_sequence_ = field.sequence;
  good_wavers_ = stamp_ == FieldCadence::Stamp::kWavers;
  even_ = true;
}

void FieldClock::see(const Field& field) {
  if (field.status != FieldStatus::kMissing) {
    cadence_.follow(field.mid_exposure, numbers_since_seen(field));
    seen_time_ = field.mid_exposure;
    seen_sequence_ = field.sequence;
  }
}

}  // namespace tubesight::core::tracking
