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
  const std::int64_t off_ns = std::abs((stamp - beat_ - time_of(numbers)).count());
  const std::int64_t step_ns = time_of(step_).count();
  if (off_ns > std::clamp(std::int64_t{4} * waver_ns_, step_ns / 4, 3 * step_ns / 4)) {
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
    step_ = static_cast<std::int32_t>(numbers);
    period_ns_ = static_cast<std::int32_t>(passed_ns / numbers);
    waver_ns_ = 0;
    count_ = 2;
    return;
  }
  const std::int64_t off_ns = passed_ns - time_of(numbers).count();
  const bool lost = count_ >= kKnown && judge(stamp, numbers) == Stamp::kAlone;
  const std::int32_t n = std::min(count_ + 1, kMemory);
  const std::int64_t waver_ns = std::min(std::abs(off_ns), time_of(step_).count());
  const std::int64_t most_ns = kSecond_ns;
  waver_ns_ = static_cast<std::int32_t>(
      std::min(waver_ns_ + (waver_ns - waver_ns_) / std::min(n, 8), most_ns));
  if (lost) {
    // One may be a stamp far off. Behind two the beat is elsewhere; after a few nothing is known.
    beat_ = strayed_ ? stamp : beat_ + time_of(numbers);
    strayed_ = !strayed_;
    count_ = count_ / 2 < kKnown ? 1 : count_ / 2;
    return;
  }
  strayed_ = false;
  // Of n samples: alpha = 2 (2 n - 1) / (n (n + 1)), beta = 6 / (n (n + 1)).
  const std::int64_t share = std::int64_t{n} * (n + 1);
  beat_ += time_of(numbers) + FieldTime(off_ns * 2 * (2 * n - 1) / share);
  period_ns_ = static_cast<std::int32_t>(
      std::clamp<std::int64_t>(period_ns_ + off_ns * 6 / share / numbers, 0, most_ns));
  count_ = n;
}

}  // namespace tubesight::core::tracking
