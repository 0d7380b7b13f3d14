#pragma once

#include <memory>
#include <string>

#include "board/visionbox/lamp_settings.h"
#include "hal/dimmer.h"

namespace tubesight::board {

/// A dimmer of whatever driver, and what that says beside.
class LampDevice {
 public:
  virtual ~LampDevice() = default;

  [[nodiscard]] virtual hal::Dimmer& dimmer() = 0;
  /// What was wrong at the last start.
  [[nodiscard]] virtual const std::string& message() const = 0;
};

/// The lamp that settings tell of; null: none.
[[nodiscard]] std::unique_ptr<LampDevice> make_lamp(const LampSettings& settings);

/// Makes the lamp dark, and nothing else: for whoever looks after a box that was killed. Empty when
/// it is done, else why not.
[[nodiscard]] std::string make_dark(LampDevice& lamp);

}  // namespace tubesight::board
