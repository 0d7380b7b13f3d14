#pragma once

#include <cerrno>
#include <chrono>
#include <ctime>

#include <semaphore.h>

#include "board/visionbox/source_clock.h"

namespace tubesight::board {

[[nodiscard]] inline timespec to_timespec(MonotonicTime instant) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  return {static_cast<std::time_t>(instant.count() / kSecond_ns),
          static_cast<long>(instant.count() % kSecond_ns)};
}

/// Sleeps until an instant; returns at once when it has passed.
inline void sleep_until(MonotonicTime instant) {
  const timespec until = to_timespec(instant);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

/// Wakes a thread that waits for something of another. Allocates nothing; wake() never waits.
class Wakeup {
 public:
  Wakeup() { sem_init(&semaphore_, 0, 0); }
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;
  ~Wakeup() { sem_destroy(&semaphore_); }

  void wake() {
    // One that nobody has waited for yet is enough: whoever waits looks at everything.
    int waiting = 0;
    sem_getvalue(&semaphore_, &waiting);
    if (waiting == 0) {
      sem_post(&semaphore_);
    }
  }

  /// Waits for a wake() that nobody has waited for yet; false at the instant given.
  bool wait_until(MonotonicTime instant) {
    const timespec until = to_timespec(instant);
    int status = 0;
    while ((status = sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &until)) != 0 && errno == EINTR) {
    }
    return status == 0;
  }

 private:
  sem_t semaphore_{};
};

}  // namespace tubesight::board
