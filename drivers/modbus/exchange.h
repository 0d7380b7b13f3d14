#pragma once

#include <atomic>
#include <cstdint>

#include <sys/eventfd.h>
#include <unistd.h>

#include "core/base/reply.h"
#include "core/base/sighting.h"
#include "core/base/snapshot.h"
#include "core/base/spsc_queue.h"
#include "drivers/modbus/link_state.h"
#include "drivers/modbus/outbox.h"

namespace tubesight::drivers {

/// Where the loop's thread and the server's meet; neither ever waits for the other.
class Exchange {
 public:
  struct Shown {
    core::Sighting sighting;
    std::uint32_t sequence = 0;
  };

  Exchange() : wake_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;
  ~Exchange() {
    if (wake_ >= 0) {
      close(wake_);
    }
  }

  EventQueue events;                         ///< from the robot to the loop
  core::SpscQueue<core::Reply, 64> replies;  ///< to the robot: two steps' full of them
  core::Snapshot<Shown> shown;
  core::Snapshot<LinkHealth> health;
  core::Snapshot<LinkSelfTest> self_test;
  core::Snapshot<LinkJournal> journal;
  core::Snapshot<LinkCounters> counters;  ///< as they are, from the server
  std::atomic<std::uint32_t> losses{0};   ///< messages that came garbled or found no room
  std::atomic<bool> connected{false};     ///< there is a line
  std::atomic<bool> stopping{false};
  std::atomic<std::int64_t> rounds{0};  ///< of the server's thread

  /// Wakes the server; never waits.
  void wake() const {
    const std::uint64_t once = 1;
    // It fails only when 2^64 calls wait, and then the server is awake.
    static_cast<void>(write(wake_, &once, sizeof once) == 0);
  }
  /// The server is awake.
  void clear_wake() const {
    std::uint64_t times = 0;
    static_cast<void>(read(wake_, &times, sizeof times) == 0);
  }
  [[nodiscard]] int wake_descriptor() const { return wake_; }

 private:
  int wake_;
};

}  // namespace tubesight::drivers
