#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "board/visionbox/link_settings.h"
#include "board/visionbox/source_clock.h"
#include "drivers/modbus/modbus_robot_link.h"
#include "hal/robot_link.h"

namespace tubesight::board {

/// How the robot's link is doing, for whoever asks.
struct LinkReport {
  bool open = false;  ///< line and port, whichever are wanted
  drivers::LinkCounters counters;
};

/// The robot's link, without which the box starts all the same: an operator can use it while the
/// line cannot be opened, and it is tried again until it can.
///
/// Opening takes its time and the heap, and is the business of the thread that starts the box and
/// looks after it; the tracking thread sees a link that is gone meanwhile.
// Final, and the port has no virtual destructor. NOLINTNEXTLINE(*-virtual-class-destructor)
class KeptLink final : public hal::RobotLink {
 public:
  using Tell = std::function<void(const std::string&)>;

  /// Whom the link's thread waits for when processors are short.
  enum class Rank : std::uint8_t { kLikeOthers, kBeforeOthers };

  /// `clock` as ModbusRobotLink's; `tell` takes lines for a person. kBeforeOthers is asked of the
  /// system and done without where it refuses.
  KeptLink(const drivers::ModbusSettings& settings, const drivers::LinkIdentity& identity,
           const hal::Clock& clock, Rank rank, Tell tell);

  /// Tries to open it. Errors: kNotReady started already.
  [[nodiscard]] core::Result<void> start() override;
  void stop() override;

  /// Tries again, once a second, where it could not be opened, and tells when a line goes or comes
  /// back. Of the thread that starts it.
  void look_after(MonotonicTime now);

  [[nodiscard]] core::Result<std::optional<core::Event>> poll_event() override;
  [[nodiscard]] core::Result<void> send_reply(const core::Reply& reply) override;
  [[nodiscard]] core::Result<void> send_sighting(const core::Sighting& sighting) override;

  /// What the robot reads of the box's parts. Of the tracking thread.
  void set_health(const drivers::LinkHealth& health) { link_.set_health(health); }

  /// What the robot reads of the box's test of itself. Of one thread.
  void set_journal(const drivers::LinkJournal& journal) { link_.set_journal(journal); }
  void set_self_test(const drivers::LinkSelfTest& self_test) { link_.set_self_test(self_test); }

  /// Any thread.
  [[nodiscard]] LinkReport report() const;

  /// Times that the link's thread has come round, which this makes it do once more; -1: it could
  /// not be opened yet, and there is none. Any thread.
  [[nodiscard]] std::int64_t rounds() const { return open_ ? link_.rounds() : -1; }

 private:
  void try_to_open(MonotonicTime now);

  drivers::ModbusRobotLink link_;
  std::string where_;  ///< line and port, for a person
  Tell tell_;
  bool started_ = false;
  bool told_ = false;  ///< that it cannot be opened
  bool connected_ = false;
  MonotonicTime next_{0};
  std::atomic<bool> open_{false};  ///< the tracking thread may use it
};

}  // namespace tubesight::board
