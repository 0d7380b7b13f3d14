#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/base/result.h"
#include "drivers/modbus/exchange.h"
#include "drivers/modbus/link_state.h"
#include "drivers/modbus/outbox.h"
#include "drivers/modbus/poll_set.h"
#include "drivers/modbus/serial_master.h"
#include "drivers/modbus/tcp_listener.h"
#include "drivers/modbus/tcp_master.h"
#include "hal/clock.h"

namespace tubesight::drivers {

/// How the robot reaches the box; the defaults are Modbus's own.
struct ModbusSettings {
  SerialService serial;  ///< no line where its device is empty
  WordOrder word_order = WordOrder::kHighFirst;
  std::string tcp_address = "127.0.0.1";
  std::int32_t tcp_port = -1;  ///< below 0: no TCP; 0: any free port
};

/// Answers the masters of a serial line and of TCP: the work of the link's own thread.
///
/// All functions but the constructor, open() and tcp_port() belong to that thread.
class ModbusServer {
 public:
  /// `exchange` and `clock` outlive the server.
  ModbusServer(const ModbusSettings& settings, const LinkIdentity& identity, Exchange& exchange,
               const hal::Clock& clock);

  /// Opens line and port. Errors: kIo, kUnsupported as SerialLine::open(); then all is closed.
  [[nodiscard]] core::Result<void> open();
  void close();
  [[nodiscard]] std::int32_t tcp_port() const { return listener_.port(); }

  /// Serves until exchange.stopping.
  void run();

 private:
  void wait();
  void take_news();
  void accept_master();
  void tell_loop();

  ModbusSettings settings_;
  Exchange* exchange_;
  const hal::Clock* clock_;
  LinkState state_;
  Outbox outbox_;
  PollSet poll_;
  SerialMaster serial_;
  TcpListener listener_;
  std::array<TcpMaster, 4> masters_;
};

}  // namespace tubesight::drivers
