#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "board/visionbox/life_signs.h"
#include "board/visionbox/service_manager.h"
#include "board/visionbox/watchdog_settings.h"
#include "drivers/watchdog/device_watchdog.h"

namespace tubesight::board {

/// How the box is watched over, for whoever asks.
struct SupervisionReport {
  std::string device;             ///< of the hardware watchdog; empty: none is wanted
  bool armed = false;             ///< that watchdog runs, and is fed
  std::int64_t timeout_s = 0;     ///< in force
  std::string trouble;            ///< why it does not; empty: it does
  bool manager = false;           ///< a service manager listens
  std::int64_t manager_ms = 0;    ///< within which it wants to be fed; 0: never
  std::int64_t manager_lost = 0;  ///< what it could not be told
  std::string stuck;              ///< the parts that stand still; empty: none does
};

/// Feeds the watchdogs, of the hardware and of the service manager, while every part of the box
/// comes round, and lets them starve as soon as one stands still.
///
/// On a thread of its own with the ordinary priority: what starves all ordinary threads starves the
/// watchdogs, too. The hardware is armed by the first look that finds the box alive.
class Supervisor {
 public:
  using Tell = std::function<void(const std::string&)>;

  /// `beats` is called on the supervisor's thread; the desk's is beat(). `manager` and `kernel`
  /// outlive the supervisor; `tell` takes lines for a person.
  Supervisor(std::function<Beats()> beats, const WatchdogSettings& settings,
             ServiceManager& manager, Tell tell,
             drivers::WatchdogKernel& kernel = drivers::system_watchdog_kernel());
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;
  ~Supervisor() { end(); }

  /// The box is started; from now on it is watched, on a thread of the supervisor's.
  void start();

  /// The desk has come round. Its thread.
  void beat() { ++desk_; }

  /// The box is being stopped, and its parts with it: fed for as long as that may take.
  void begin_to_stop();

  /// The box was stopped in order: disarms the hardware.
  void stop();

  /// One look, on the thread that calls: what start() repeats.
  void look(MonotonicTime now);

  /// Any thread.
  [[nodiscard]] SupervisionReport report() const;

 private:
  void end();
  void feed_hardware(MonotonicTime now);
  void feed_manager(MonotonicTime now);
  void trouble(const std::string& why);

  std::function<Beats()> beats_;
  WatchdogSettings settings_;
  ServiceManager* manager_;
  Tell tell_;
  drivers::DeviceWatchdog hardware_;
  LifeSigns signs_;
  std::thread thread_;
  std::atomic<bool> ended_{false};
  std::atomic<std::int64_t> desk_{0};
  std::atomic<std::int64_t> stop_by_ns_{0};  ///< 0: the box is not being stopped
  // Of the supervisor's thread.
  MonotonicTime next_open_{0};
  MonotonicTime next_manager_{0};
  std::string told_stuck_;

  mutable std::mutex mutex_;  ///< of what follows
  bool armed_ = false;
  std::int64_t timeout_s_ = 0;
  std::string trouble_;
  std::string stuck_;
};

}  // namespace tubesight::board
