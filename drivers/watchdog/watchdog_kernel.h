#pragma once

#include <cstdint>
#include <string>

namespace tubesight::drivers {

/// What a watchdog can do, as its driver says.
struct WatchdogAbilities {
  std::string name;
  bool can_be_timed = false;    ///< it takes a time-out
  bool can_be_stopped = false;  ///< by the magic character, before it is closed
};

/// The system calls on a watchdog's device: where a test looks at what is asked, in which order.
class WatchdogKernel {
 public:
  /// Opens and arms; a descriptor, or -errno.
  [[nodiscard]] virtual int open(const std::string& path) = 0;
  /// 0, or -errno.
  [[nodiscard]] virtual int abilities(int device, WatchdogAbilities& abilities) = 0;
  /// Asks for a time-out; `seconds` becomes the one in force. 0, or -errno.
  [[nodiscard]] virtual int set_timeout(int device, std::int32_t& seconds) = 0;
  /// 0, or -errno.
  [[nodiscard]] virtual int keep_alive(int device) = 0;
  /// Writes one character. 0, or -errno.
  [[nodiscard]] virtual int write(int device, char character) = 0;
  virtual void close(int device) = 0;

 protected:
  ~WatchdogKernel() = default;
};

/// This machine's.
[[nodiscard]] WatchdogKernel& system_watchdog_kernel();

}  // namespace tubesight::drivers
