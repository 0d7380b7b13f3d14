#pragma once

#include <chrono>

#include "core/base/result.h"

namespace tubesight::hal {

/// Hardware that resets the machine when nobody has fed it for a while.
///
/// It runs from start() on, whatever becomes of the program; stop() alone ends it, where the
/// hardware lets it be ended at all. One thread calls all functions.
class Watchdog {
 public:
  /// Arms it; from now on feed() is due within `timeout`, or within what the hardware takes instead
  /// (timeout()). Needs: not started. After an error it is not armed and start() may be tried
  /// again.
  ///
  /// Errors: kIo it cannot be had, kOutOfRange the hardware takes no such time, kNotReady already
  /// started.
  [[nodiscard]] virtual core::Result<void> start(std::chrono::seconds timeout) = 0;

  /// Disarms it. Calling it when not started does nothing.
  virtual void stop() = 0;

  /// Begins its time anew. Errors: kNotReady not started, kDisconnected it is gone or refuses; it
  /// stays started, and stop() and start() may bring it back.
  [[nodiscard]] virtual core::Result<void> feed() = 0;

  /// In force; 0 when not started.
  [[nodiscard]] virtual std::chrono::seconds timeout() const = 0;

 protected:
  ~Watchdog() = default;
};

}  // namespace tubesight::hal
