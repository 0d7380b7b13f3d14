#pragma once

#include <cstdint>

#include "core/base/result.h"

namespace tubesight::hal {

/// Levels run from dark to this.
inline constexpr std::int32_t kFullLevel_permille = 1000;

/// Sets the light of the lighthouse lamp.
///
/// A level is a command, not a measurement. A dead lamp, or one that fails in part, takes every
/// level without an error: a dimmer drives its output and sees no light. Whether light came of it
/// is told by the next pictures. One thread calls all functions.
class Dimmer {
 public:
  /// Opens the device; the lamp is dark until the first set_level(). Needs: not started. After an
  /// error the dimmer is as before and start() may be tried again.
  ///
  /// Errors: kIo the device cannot be opened, kNotReady already started.
  [[nodiscard]] virtual core::Result<void> start() = 0;

  /// Makes the lamp dark, as far as the device still obeys, and closes the device. Calling it when
  /// not started does nothing.
  virtual void stop() = 0;

  /// Sets the level, 0 (dark) to kFullLevel_permille, in proportion to the light's mean power.
  ///
  /// Takes 1 ms at most and never waits for the lamp: the light follows with the lamp's own lag, so
  /// that a field exposed in between shows neither the old nor the new level. Setting the level in
  /// force again is allowed and costs as much. After an error the level in force is the one before
  /// (kOutOfRange, kNotReady) or unknown (kIo, kDisconnected); the dimmer stays started and the
  /// next call may succeed.
  ///
  /// Errors: kOutOfRange the level is below 0 or above full, kNotReady not started, kIo the device
  /// refused, kDisconnected it is gone.
  [[nodiscard]] virtual core::Result<void> set_level(std::int32_t permille) = 0;

  /// The level that was last set without an error; 0 before the first and when stopped.
  [[nodiscard]] virtual std::int32_t level_permille() const = 0;

 protected:
  ~Dimmer() = default;
};

}  // namespace tubesight::hal
