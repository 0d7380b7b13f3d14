#pragma once

#include <chrono>
#include <string>

#include "drivers/watchdog/watchdog_kernel.h"
#include "hal/watchdog.h"

namespace tubesight::drivers {

/// A watchdog of the kernel, /dev/watchdog and its like.
///
/// The kernel gives such a device to one program at a time. Opening arms it; closing disarms it
/// only behind the magic character 'V', so that a program that dies leaves it armed. One whose
/// driver knows no magic character, or was told never to end (nowayout), goes on after stop() and
/// resets the machine: note() says so.
// Final, and the port has no virtual destructor. NOLINTNEXTLINE(*-virtual-class-destructor)
class DeviceWatchdog final : public hal::Watchdog {
 public:
  /// `kernel` is the system's but for tests.
  explicit DeviceWatchdog(std::string path, WatchdogKernel& kernel = system_watchdog_kernel())
      : path_(std::move(path)), kernel_(&kernel) {}
  DeviceWatchdog(const DeviceWatchdog&) = delete;
  DeviceWatchdog& operator=(const DeviceWatchdog&) = delete;
  /// Leaves it armed, as a program that dies does; stop() disarms it.
  ~DeviceWatchdog();

  /// A device that takes no time-out, or another one than asked for, is used with its own, and
  /// note() says so. message() says what is wrong.
  [[nodiscard]] core::Result<void> start(std::chrono::seconds timeout) override;
  void stop() override;
  [[nodiscard]] core::Result<void> feed() override;
  [[nodiscard]] std::chrono::seconds timeout() const override { return timeout_; }

  /// Of the last start() or feed() that failed; in one line, with the device's name.
  [[nodiscard]] const std::string& message() const { return message_; }
  /// What a person should know of a watchdog that was started; may be empty.
  [[nodiscard]] const std::string& note() const { return note_; }
  /// As its driver calls it; empty before the first start().
  [[nodiscard]] const std::string& name() const { return abilities_.name; }

 private:
  [[nodiscard]] core::Result<void> refuse(core::Error error, const std::string& what);
  void disarm();

  std::string path_;
  WatchdogKernel* kernel_;
  WatchdogAbilities abilities_;
  std::string message_;
  std::string note_;
  std::chrono::seconds timeout_{0};
  int device_ = -1;
};

}  // namespace tubesight::drivers
