#include "core/tracking/field_cadence.h"

#include <algorithm>
#include <cstdlib>

namespace tubesight::core::tracking {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
// What a driver's own stamps waver by.
constexpr std::int64_t kExact_ns = 500'000;
constexpr std::int32_t kKnown = 4;  // fields, until there is a beat to judge by

}  // namespace

void FieldCadence::begin_at(FieldTime stamp) {
  beat_ = stamp;
  count_ = 1;
  strayed_ = false;
}

// A field left out without a number is a step late and stays so: less than that may be wavering,
// three quarters of a step where stamps were seen to waver as much, a quarter where not.
FieldCadence::Stamp FieldCadence::judge(FieldTime stamp, std::int64_t numbers) const {
  if (count_ < kKnown || numbers < 1 || numbers > kMostNumbers) {
    return Stamp::kAlone;
  }
  const std::int64_t off_ns = std::abs((stamp - beat_).count() - numbers * period_ns_);
  const std::int64_t step_ns = step_ * period_ns_;
  if (off_ns > std::clamp(4 * waver_ns_, step_ns / 4, 3 * step_ns / 4)) {
    return Stamp::kAlone;
  }
  return off_ns <= kExact_ns ? Stamp::kExact : Stamp::kWavers;
}

void FieldCadence::follow(FieldTime stamp, std::int64_t numbers) {
  const std::int64_t passed_ns = (stamp - beat_).count();
  if (count_ == 0 || numbers < 1 || numbers > kMostNumbers || passed_ns < 0 ||
      passed_ns > kSecond_ns) {
    begin_at(stamp);
    return;
  }
  if (count_ == 1 || numbers < step_) {
    begin_at(stamp);
    step_ = numbers;
    period_ns_ = passed_ns / numbers;
    waver_ns_ = 0;
    count_ = 2;
    return;
  }
  const std::int64_t off_ns = passed_ns - numbers * period_ns_;
  const std::int64_t waver_ns = std::min(std::abs(off_ns), step_ * period_ns_);
  const bool lost = count_ >= kKnown && judge(stamp, numbers) == Stamp::kAlone;
  const std::int64_t n = std::min(count_ + 1, kMemory);
  waver_ns_ += (waver_ns - waver_ns_) / std::min<std::int64_t>(n, 8);
  if (lost) {
    // One may be a stamp far off. Behind two the beat is elsewhere; after a few nothing is known.
    beat_ = strayed_ ? stamp : beat_ + time_of(numbers);
    strayed_ = !strayed_;
    count_ = count_ / 2 < kKnown ? 1 : count_ / 2;
    return;
  }
  strayed_ = false;
  // Of n samples: alpha = 2 (2 n - 1) / (n (n + 1)), beta = 6 / (n (n + 1)).
  const std::int64_t share = n * (n + 1);
  beat_ += FieldTime(numbers * period_ns_ + off_ns * 2 * (2 * n - 1) / share);
  period_ns_ = std::clamp<std::int64_t>(period_ns_ + off_ns * 6 / share / numbers, 0, kSecond_ns);
  count_ = static_cast<std::int32_t>(n);
}

}  // namespace tubesight::core::tracking
