#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "hal/dimmer.h"

namespace tubesight::board {

/// The box's dimmer, which goes dark when the program dies of a mistake of its own: a failed
/// assertion, an exception that nobody catches, a deadly signal.
///
/// Nobody may then light the lamp again, as the other threads go on for a moment. The robot's line
/// needs nothing: a program that is dead answers nobody. Of two that are started the last is made
/// dark. Against SIGKILL nothing helps but hardware.
class PanicDimmer final : public hal::Dimmer {
 public:
  /// `lamp` outlives this. Its set_level(0) is called from a signal's handler, on whatever thread:
  /// it may neither lock nor allocate.
  explicit PanicDimmer(hal::Dimmer& lamp) : lamp_(&lamp) {}
  PanicDimmer(const PanicDimmer&) = delete;
  PanicDimmer& operator=(const PanicDimmer&) = delete;
  ~PanicDimmer() { forget(); }

  [[nodiscard]] core::Result<void> start() override;
  void stop() override;
  /// Also kNotReady: the program is dying.
  [[nodiscard]] core::Result<void> set_level(std::int32_t permille) override;
  [[nodiscard]] std::int32_t level_permille() const override { return lamp_->level_permille(); }

  /// Makes the lamp of whoever was started last dark. Of a signal's handler.
  static void darken();

 private:
  void forget();

  hal::Dimmer* lamp_;
};

/// From now on the program's death makes the lamp dark, says why in one line to standard error, and
/// is the same death otherwise. Once, before any thread runs. Calls use_signal_stack().
void install_panic_hooks();

/// Gives the calling thread a stack for deadly signals, until it ends: on its own one, when that
/// has overflowed, no handler can run. At a thread's start, as it allocates.
void use_signal_stack();

}  // namespace tubesight::board
