#pragma once

#include <chrono>
#include <cstdint>

#include <sys/timerfd.h>
#include <unistd.h>

namespace tubesight::drivers {

/// A kernel timer that poll() can wait for: it runs whatever the clock of the fields does.
class Timer {
 public:
  Timer() : descriptor_(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {}
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
  ~Timer() {
    if (descriptor_ >= 0) {
      close(descriptor_);
    }
  }

  /// For poll(); below 0: the system has none left, and the timer never goes off.
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Goes off once, so long from now; replaces what was set before.
  void set(std::chrono::nanoseconds from_now) const {
    constexpr std::int64_t kSecond = 1'000'000'000;
    itimerspec spec{};
    spec.it_value.tv_sec = static_cast<time_t>(from_now.count() / kSecond);
    spec.it_value.tv_nsec = static_cast<long>(from_now.count() % kSecond);
    timerfd_settime(descriptor_, 0, &spec, nullptr);
  }

  void cancel() const {
    const itimerspec never{};
    timerfd_settime(descriptor_, 0, &never, nullptr);
  }

  /// Whether it has gone off since it was set; says so once.
  [[nodiscard]] bool went_off() const {
    std::uint64_t times = 0;
    return read(descriptor_, &times, sizeof times) == static_cast<ssize_t>(sizeof times);
  }

 private:
  int descriptor_;
};

}  // namespace tubesight::drivers
