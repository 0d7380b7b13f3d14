#pragma once

#include <cstdint>
#include <optional>
#include <thread>

#include "core/base/event.h"
#include "core/base/reply.h"
#include "core/base/result.h"
#include "core/base/sighting.h"
#include "drivers/modbus/exchange.h"
#include "drivers/modbus/link_state.h"
#include "drivers/modbus/modbus_server.h"
#include "hal/clock.h"
#include "hal/robot_link.h"

namespace tubesight::drivers {

/// The link to a robot that speaks Modbus; docs/robot-link.md is what it says.
///
/// A thread of its own answers the masters within milliseconds, from the latest of what the loop
/// has said; the loop never waits for a line. That thread has the ordinary priority, whatever the
/// priority of who starts it, unless `at_thread_start` gives it another. Between start() and stop()
/// nothing is allocated but where a line is opened again.
// Final, and the port has no virtual destructor. NOLINTNEXTLINE(*-virtual-class-destructor)
class ModbusRobotLink final : public hal::RobotLink {
 public:
  /// `clock` stamps the fields, outlives the link and is asked by the link's thread, too.
  /// `at_thread_start`, where it is given, is called on that thread before all else it does.
  ModbusRobotLink(const ModbusSettings& settings, const LinkIdentity& identity,
                  const hal::Clock& clock, void (*at_thread_start)() = nullptr);
  ModbusRobotLink(const ModbusRobotLink&) = delete;
  ModbusRobotLink& operator=(const ModbusRobotLink&) = delete;
  ~ModbusRobotLink() { stop(); }

  /// Errors beside the port's: kUnsupported the line's driver cannot switch RS-485.
  [[nodiscard]] core::Result<void> start() override;
  void stop() override;
  [[nodiscard]] core::Result<std::optional<core::Event>> poll_event() override;
  [[nodiscard]] core::Result<void> send_reply(const core::Reply& reply) override;
  [[nodiscard]] core::Result<void> send_sighting(const core::Sighting& sighting) override;

  /// What the robot reads of the box's parts; any one thread, started or not.
  void set_health(const LinkHealth& health) { exchange_.health.publish(health); }

  /// What the robot reads of the box's test of itself; any one thread, started or not.
  void set_journal(const LinkJournal& journal) { exchange_.journal.publish(journal); }
  void set_self_test(const LinkSelfTest& self_test) { exchange_.self_test.publish(self_test); }

  /// What has come over the line so far; false where it changes just now, or nothing came since
  /// the first start. Any thread.
  [[nodiscard]] bool counters(LinkCounters& counters) const {
    return exchange_.counters.try_read(counters);
  }

  /// Times that the link's thread has come round. It waits for the masters alone: asking wakes it,
  /// so that the next answer is another one, unless it stands still. Any thread.
  [[nodiscard]] std::int64_t rounds() const {
    exchange_.wake();
    return exchange_.rounds.load();
  }

  /// Whether there is a line or a port at present. Any thread.
  [[nodiscard]] bool connected() const { return exchange_.connected.load(); }

  /// The port that masters of TCP come in at; 0: none. Needs: started.
  [[nodiscard]] std::int32_t tcp_port() const { return server_.tcp_port(); }

 private:
  [[nodiscard]] core::Result<void> usable() const;

  Exchange exchange_;
  ModbusServer server_;
  void (*at_thread_start_)();
  std::thread thread_;
  bool started_ = false;
  std::uint32_t losses_told_ = 0;
  std::uint32_t sequence_ = 0;
};

}  // namespace tubesight::drivers
