#pragma once

#include <cstdint>
#include <string>

#include "drivers/pwm/pwm_chips.h"
#include "drivers/pwm/pwm_files.h"
#include "hal/dimmer.h"

namespace tubesight::drivers {

/// A channel of a PWM chip and how the lamp hangs on it.
struct PwmSettings {
  std::string chip;  ///< by its device, which stays: "fe20c000.pwm"; or by its name, "pwmchip0"
  std::int32_t channel = 0;
  std::int32_t frequency_hz = 2000;  ///< above what beats with an exposure
  bool inverted = false;             ///< the lamp shines while the output is low
};

/// A lamp on a channel of the kernel's PWM.
///
/// The hardware makes the pulses: they go on at the last level when the program dies, and nobody
/// but a program started after it (the service manager's) can end that. An inverted lamp is
/// inverted in the times and not by the chip's polarity: a chip that is switched off lets its
/// output fall, where that lamp would shine in full. For the same reason the channel stays enabled
/// and exported, at dark, after stop(). Whatever somebody left there, the way to a start is as dark
/// as the kernel lets it be. Of two programs, or two lamps of one, the second is refused the
/// channel.
class PwmDimmer final : public hal::Dimmer {
 public:
  /// `root` is kPwmClass and `files` the system's but for tests.
  explicit PwmDimmer(PwmSettings settings, std::string root = kPwmClass,
                     PwmFiles& files = system_pwm_files());
  PwmDimmer(const PwmDimmer&) = delete;
  PwmDimmer& operator=(const PwmDimmer&) = delete;
  ~PwmDimmer() { stop(); }

  /// May take half a second, until the system has given us the channel's files. message() says what
  /// is wrong.
  [[nodiscard]] core::Result<void> start() override;
  void stop() override;
  [[nodiscard]] core::Result<void> set_level(std::int32_t permille) override;
  [[nodiscard]] std::int32_t level_permille() const override { return level_permille_; }

  /// Of the last start(); empty after a good one.
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  core::Result<void> refuse(const std::string& what);
  core::Result<void> open_channel();
  core::Result<void> take_channel();
  core::Result<void> make_dark();
  core::Result<void> set_period(std::int64_t old_period_ns);
  core::Result<void> turn_over();
  core::Result<void> put(const char* file, const std::string& value);
  [[nodiscard]] int write_level(std::int32_t permille) const;

  PwmSettings settings_;
  std::string root_;
  PwmFiles* files_;
  std::string message_;
  std::string channel_;  ///< its folder
  std::int64_t period_ns_ = 0;
  int duty_ = -1;  ///< descriptor of the file that is written on the way
  std::int32_t level_permille_ = 0;
};

}  // namespace tubesight::drivers
