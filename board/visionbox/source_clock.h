#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "hal/clock.h"

namespace tubesight::board {

/// An instant of the system's monotonic clock: what threads of the box sleep and measure by.
using MonotonicTime = std::chrono::nanoseconds;
[[nodiscard]] inline MonotonicTime monotonic_now() {
  return std::chrono::steady_clock::now().time_since_epoch();
}

/// The clock of a source that is played in real time: runs with the system's monotonic clock, from
/// an instant that the source's first field chooses. Until then it stands at zero.
class SourceClock final : public hal::Clock {
 public:
  [[nodiscard]] core::FieldTime now() const override {
    const std::int64_t zero = zero_.load(std::memory_order_acquire);
    return zero == kUnset ? core::FieldTime{0} : monotonic_now() - MonotonicTime{zero};
  }

  [[nodiscard]] bool running() const { return zero_.load(std::memory_order_acquire) != kUnset; }

  /// `instant` of the source is `at`. Once, before anybody can have read more than zero; again only
  /// by a source for which time stood still.
  void set(core::FieldTime instant, MonotonicTime at) {
    zero_.store((at - instant).count(), std::memory_order_release);
  }

  /// The system's instant at which this clock shows `instant`; running only.
  [[nodiscard]] MonotonicTime monotonic(core::FieldTime instant) const {
    return instant + MonotonicTime{zero_.load(std::memory_order_acquire)};
  }

 private:
  static constexpr std::int64_t kUnset = INT64_MIN;
  std::atomic<std::int64_t> zero_{kUnset};
};

}  // namespace tubesight::board
