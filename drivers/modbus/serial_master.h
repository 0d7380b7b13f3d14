#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/field.h"
#include "core/base/result.h"
#include "drivers/modbus/conversation.h"
#include "drivers/modbus/echo_filter.h"
#include "drivers/modbus/poll_set.h"
#include "drivers/modbus/rtu_framer.h"
#include "drivers/modbus/serial_line.h"
#include "drivers/modbus/timer.h"
#include "hal/clock.h"

namespace tubesight::drivers {

/// How a serial line is served.
struct SerialService {
  SerialSettings line;
  std::uint8_t unit = 1;  ///< 1 to 247
  /// Silence after which a frame is over; no less than 3.5 characters are taken.
  std::chrono::milliseconds frame_gap{5};
};

/// The master at the other end of a serial line. One thread; after open() no heap, but where the
/// line is opened again.
class SerialMaster {
 public:
  SerialMaster(const SerialService& service, WordOrder order, LinkState& state, Outbox& outbox,
               const hal::Clock& clock);

  /// Errors: as SerialLine::open().
  [[nodiscard]] core::Result<void> open();
  void close();
  [[nodiscard]] bool is_open() const { return line_.is_open(); }

  void add_to(PollSet& poll) const;
  /// Does what there is to do.
  void serve(const PollSet& poll);
  void hear(const core::Reply& reply, core::FieldTime now) { conversation_.hear(reply, now); }
  /// Sends the answer that waited for a verdict, if it is there and the line is silent; call
  /// serve() before, so that what has come is known.
  void finish();

 private:
  void lose_line();
  void receive();
  void receive_byte(std::uint8_t byte, core::FieldTime arrival);
  void read_held(core::FieldTime arrival);
  void end_with_silence();
  void take(Found found, core::FieldTime arrival);
  void abandon();
  void send();

  SerialService service_;
  LinkState* state_;
  const hal::Clock* clock_;
  std::chrono::nanoseconds gap_;
  SerialLine line_;
  EchoFilter echo_;
  RtuFramer framer_;
  Conversation conversation_;
  Timer silence_;
  Timer reopen_;
  std::optional<ReadyAnswer> answer_;  ///< to what was read last
};

/// Counts an answer that was sent, and how long it took.
void count_answer(const ReadyAnswer& answer, core::FieldTime now, LinkCounters& counters);

}  // namespace tubesight::drivers
