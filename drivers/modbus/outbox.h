#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
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
    ++sent_;
    return event.id;
  }

  /// How many were sent, and how many of them the loop has taken.
  [[nodiscard]] std::uint64_t sent() const { return sent_; }
  [[nodiscard]] std::uint64_t taken() const { return sent_ - queue_->size(); }

 private:
  static constexpr std::int64_t kTicket = std::int64_t{1} << 32;
  static constexpr std::int64_t kMostTickets = INT32_MAX;

  EventQueue* queue_;
  std::int64_t ticket_ = 0;
  std::uint64_t sent_ = 0;
};

/// A master's part of the outbox: one that asks faster than the loop listens fills its own part and
/// shuts nobody out.
class OutboxShare {
 public:
  /// What of one master may wait for the loop: all five commands at once, or three claims. Five
  /// masters together have room, and claims enough with a session that judges 16 a field.
  static constexpr std::int32_t kMostEvents = 5;
  static constexpr std::int32_t kMostClaims = 3;
  static_assert(5 * kMostEvents <= EventQueue::capacity());

  explicit OutboxShare(Outbox& outbox) : outbox_(&outbox) {}

  /// Whether as many events find room when at most `most` may wait.
  [[nodiscard]] bool has_room(std::int32_t events, std::int32_t most) const {
    const std::uint64_t taken = outbox_->taken();
    const auto waiting =
        std::count_if(sent_.begin(), sent_.end(), [&](std::uint64_t at) { return at > taken; });
    return waiting + events <= most && outbox_->has_room(events);
  }

  /// As Outbox::send().
  template <typename Content>
  std::int64_t send(const Content& content, std::int32_t robot_id, core::FieldTime at) {
    const std::int64_t id = outbox_->send(content, robot_id, at);
    sent_[next_] = outbox_->sent();
    next_ = (next_ + 1) % sent_.size();
    return id;
  }

 private:
  Outbox* outbox_;
  std::array<std::uint64_t, kMostEvents> sent_{};  ///< the last ones, counted with all others'
  std::size_t next_ = 0;
};

}  // namespace tubesight::drivers
