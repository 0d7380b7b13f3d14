#include "drivers/aravis/camera_clock.h"

#include <algorithm>
#include <chrono>

namespace tubesight::drivers::aravis {
namespace {

using core::FieldTime;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// How long a picture may have waited: more than all buffers together hold.
constexpr std::int64_t kOldest_ns = 2 * kSecond_ns;
/// What is followed: twice what two quartzes differ by.
constexpr std::int64_t kMostDrift_ppb = 200'000;
/// What no clock drifts by. The minima of four seconds would have to be late by 8 ms for it.
constexpr std::int64_t kNoClock_ppb = 2'000'000;
/// A picture may come earlier than the one before it by this part of a frame's time: it waited
/// less.
constexpr std::int64_t kPartOfFrame = 4;

/// What a drift makes of a time, ns. By whole milliseconds: the product stays below 2^63 for all
/// that a stamp may be.
constexpr std::int64_t drifted(std::int64_t gone_ns, std::int64_t drift_ppb) {
  return gone_ns / 1'000'000 * drift_ppb / 1000;
}

}  // namespace

void CameraClock::begin(FieldTime frame) {
  frame_ = frame;
  last_stamp_ = 0;
  distrusted_ = false;
  unsettled_ = 0;
  floor_ = INT64_MAX;
  forget();
}

void CameraClock::forget() {
  seconds_ = 0;
  drift_ppb_ = 0;
  agreed_ = 0;
}

const CameraClock::Least& CameraClock::least_of(std::size_t from, std::size_t to) const {
  return *std::min_element(
      least_.begin() + static_cast<std::ptrdiff_t>(from),
      least_.begin() + static_cast<std::ptrdiff_t>(to),
      [](const Least& a, const Least& b) { return a.difference < b.difference; });
}

/// The smallest difference that there can be at a stamp, by those known.
std::int64_t CameraClock::least_at(std::int64_t stamp) const {
  std::int64_t least = INT64_MAX;
  for (std::size_t i = 0; i < seconds_; ++i) {
    least = std::min(least, least_[i].difference + drifted(stamp - least_[i].at, drift_ppb_));
  }
  return least;
}

/// The most that the difference of a picture that did not wait can be.
std::int64_t CameraClock::floor_at(std::int64_t stamp) const {
  if (floor_ == INT64_MAX) {
    return INT64_MAX;
  }
  return floor_ + drifted(stamp - floor_at_, kMostDrift_ppb);
}

void CameraClock::follow_drift() {
  if (seconds_ < kSeconds) {
    return;
  }
  const Least& older = least_of(0, kSeconds / 2);
  const Least& newer = least_of(kSeconds / 2, kSeconds);
  const std::int64_t gone_us = std::max<std::int64_t>((newer.at - older.at) / 1000, 1);
  // At most 2 s of 10^9 ns, times 10^6: below 2^63.
  const std::int64_t drift_ppb = (newer.difference - older.difference) * 1'000'000 / gone_us;
  distrusted_ = drift_ppb > kNoClock_ppb || drift_ppb < -kNoClock_ppb;
  drift_ppb_ = std::clamp(drift_ppb, -kMostDrift_ppb, kMostDrift_ppb);
}

void CameraClock::take(std::int64_t stamp, std::int64_t difference) {
  const std::int64_t second = stamp / kSecond_ns;
  if (seconds_ > 0 && least_[seconds_ - 1].second == second) {
    Least& now = least_[seconds_ - 1];
    if (difference < now.difference) {
      now.at = stamp;
      now.difference = difference;
    }
    return;
  }
  follow_drift();
  if (seconds_ == kSeconds) {
    std::shift_left(least_.begin(), least_.end(), 1);
    --seconds_;
  }
  least_[seconds_++] = {second, stamp, difference};
}

/// What is wrong begins the agreement anew.
CameraClock::Reading CameraClock::doubt(Verdict verdict, FieldTime arrival) {
  forget();
  distrusted_ = ++unsettled_ >= kMostUnsettled;
  return {arrival, verdict};
}

CameraClock::Reading CameraClock::read(std::uint64_t stamp_ns, FieldTime arrival) {
  if (distrusted_ || (stamp_ns == 0 && last_stamp_ == 0)) {
    return {arrival, Verdict::kByArrival};
  }
  // What does not fit would overflow below: no clock has run for so long.
  if (stamp_ns > static_cast<std::uint64_t>(INT64_MAX / 2)) {
    return doubt(Verdict::kJumped, arrival);
  }
  const auto stamp = static_cast<std::int64_t>(stamp_ns);
  const bool back = stamp <= last_stamp_;
  last_stamp_ = std::max<std::int64_t>(stamp, 1);
  if (back) {
    floor_ = INT64_MAX;  // another clock: the camera was switched off and on, say
    return doubt(Verdict::kWentBack, arrival);
  }
  const std::int64_t difference = arrival.count() - stamp;
  const bool settled = agreed_ >= kSettled;
  if (seconds_ > 0) {
    const std::int64_t later = difference - least_at(stamp);
    if (later > kOldest_ns) {
      // Nothing is learnt of it: it stays too old, however many others come as late.
      return {FieldTime{stamp + least_at(stamp)}, Verdict::kTooOld};
    }
    if (later < -frame_.count() / kPartOfFrame) {
      // The pictures before were older than they looked, or this one's clock is ahead.
      const Reading reading = doubt(settled ? Verdict::kJumped : Verdict::kSettling, arrival);
      floor_ = difference;
      floor_at_ = stamp;
      take(stamp, difference);
      agreed_ = 1;
      return reading;
    }
  }
  floor_ = std::min(difference, floor_at(stamp));
  floor_at_ = stamp;
  take(stamp, floor_);
  const FieldTime time{stamp + std::min(least_at(stamp), difference)};
  if (distrusted_) {
    return {arrival, Verdict::kByArrival};
  }
  if (++agreed_ <= kSettled) {
    distrusted_ = ++unsettled_ >= kMostUnsettled;
    return {time, Verdict::kSettling};
  }
  agreed_ = kSettled;
  unsettled_ = 0;
  return {time, Verdict::kGood};
}

}  // namespace tubesight::drivers::aravis
