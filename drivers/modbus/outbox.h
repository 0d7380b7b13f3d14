#pragma once

#include <cstdint>

#include "core/base/event.h"
#include "core/base/spsc_queue.h"

namespace tubesight::drivers {

/// Requests of the robot on their way to the loop: two fields' full of them.
using EventQueue = core::SpscQueue<core::Event, 2 * core::kMaxEventsPerField>;

/// Sends what the robot asks for to the loop, each under an id that no other event of the link has:
/// a robot may use its own ids twice, and would then be told the answer to the request before.
///
/// One thread, the queue's pushing one; no heap.
class Outbox {
 public:
  explicit Outbox(EventQueue& queue) : queue_(&queue) {}

  /// Whether as many events find room.
  [[nodiscard]] bool has_room(std::int32_t events) const {
    return queue_->size() + static_cast<std::uint32_t>(events) <= EventQueue::capacity();
  }

  /// Sends an event and gives its id, of which the lower half is the robot's; needs room.
  template <typename Content>
  std::int64_t send(const Content& content, std::int32_t robot_id, core::FieldTime at) {
    ticket_ = ticket_ % kMostTickets + 1;
    core::Event event;
    event.id = ticket_ * kTicket + static_cast<std::uint32_t>(robot_id);
    event.at = at;
    event.content = content;
    static_cast<void>(queue_->try_push(event));
    return event.id;
  }

 private:
  static constexpr std::int64_t kTicket = std::int64_t{1} << 32;
  static constexpr std::int64_t kMostTickets = INT32_MAX;

  EventQueue* queue_;
  std::int64_t ticket_ = 0;
};

}  // namespace tubesight::drivers
