#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/field.h"
#include "drivers/modbus/conversation.h"
#include "drivers/modbus/poll_set.h"
#include "drivers/modbus/tcp_framer.h"
#include "hal/clock.h"

namespace tubesight::drivers {

/// A master that came in over TCP, or a place for one. One thread; no heap.
class TcpMaster {
 public:
  TcpMaster(std::uint8_t unit, WordOrder order, LinkState& state, Outbox& outbox,
            const hal::Clock& clock)
      : unit_(unit), state_(&state), clock_(&clock), conversation_(order, state, outbox) {}
  TcpMaster(const TcpMaster&) = delete;
  TcpMaster& operator=(const TcpMaster&) = delete;
  ~TcpMaster() { close(); }

  /// Takes a connection over; one that was there is closed.
  void open(int descriptor);
  void close();
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  /// When it was heard last.
  [[nodiscard]] core::FieldTime heard() const { return heard_; }

  void add_to(PollSet& poll) const;
  void serve(const PollSet& poll);
  void hear(const core::Reply& reply, core::FieldTime now) { conversation_.hear(reply, now); }
  void finish();

 private:
  void receive();
  void take_received();
  void send(const ReadyAnswer& answer);

  std::uint8_t unit_;
  LinkState* state_;
  const hal::Clock* clock_;
  int descriptor_ = -1;
  TcpFramer framer_;
  Conversation conversation_;
  core::FieldTime heard_{0};
  /// Requests may be sent ahead: what came behind one whose answer waits stays here, and the rest
  /// with the kernel.
  std::array<std::uint8_t, 512> received_{};
  std::size_t count_ = 0;
  std::size_t taken_ = 0;
  /// How many of them, and of those that are with the kernel, came while an answer waited.
  std::size_t late_ = 0;
  std::size_t late_unread_ = 0;
};

}  // namespace tubesight::drivers
