#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "drivers/gpio/line_bank.h"
#include "hal/dimmer.h"

namespace tubesight::drivers {

/// Lines and what is made of them.
struct GpioSettings {
  LineBankSettings bank;
  std::int32_t frequency_hz = 1000;  ///< of the pulses on a single line
  std::int32_t priority = 60;        ///< SCHED_FIFO of their thread; 0: like every other
};

/// A lamp on GPIO lines: one line by pulses that a thread makes, several as steps of light.
///
/// Of several lines the first k of n shine, so that the steps are of the same size where the lamps
/// behind them are; a level goes to the nearest step. Pulses are as good as the thread's timing:
/// what a line does when the program dies is what it does at that moment, until the kernel has
/// taken it back; then the chip decides, and most keep the last value.
class GpioDimmer final : public hal::Dimmer {
 public:
  explicit GpioDimmer(GpioSettings settings,
                      std::unique_ptr<LineBank> bank = make_gpiod_line_bank());
  GpioDimmer(const GpioDimmer&) = delete;
  GpioDimmer& operator=(const GpioDimmer&) = delete;
  ~GpioDimmer() { stop(); }

  /// message() says what is wrong.
  [[nodiscard]] core::Result<void> start() override;
  void stop() override;
  /// Dark is there at once; other levels of a pulsed line with its next pulse. Neither locks nor
  /// allocates.
  [[nodiscard]] core::Result<void> set_level(std::int32_t permille) override;
  [[nodiscard]] std::int32_t level_permille() const override { return level_permille_; }

  /// Of the last start(); empty after a good one.
  [[nodiscard]] const std::string& message() const { return message_; }

  /// Whether the pulses' thread has the priority that was wanted. Any thread.
  [[nodiscard]] bool prioritised() const { return prioritised_; }

  /// Pulses that began over a period late, and were left out. Any thread.
  [[nodiscard]] std::int64_t late_pulses() const { return late_; }

 private:
  [[nodiscard]] bool pulsed() const { return settings_.bank.lines.size() == 1; }
  [[nodiscard]] std::uint32_t steps_of(std::int32_t permille) const;
  void pulse();
  void set_line(bool lit);

  GpioSettings settings_;
  std::unique_ptr<LineBank> bank_;
  std::string message_;
  bool started_ = false;
  std::int32_t level_permille_ = 0;

  std::thread thread_;
  int period_timer_ = -1;
  int pulse_timer_ = -1;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> prioritised_{false};
  std::atomic<std::int32_t> wanted_permille_{0};
  std::atomic<int> status_{0};  ///< -errno of a change of the line that was refused; 0: none was
  bool lit_ = false;            ///< of the thread
  std::atomic<bool> darkened_{false};  ///< past the thread, whose lit_ may be wrong
  std::atomic<std::int64_t> late_{0};
};

}  // namespace tubesight::drivers
