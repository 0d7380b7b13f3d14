#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/image_view.h"
#include "drivers/simulated/dice.h"
#include "drivers/simulated/fault_schedule.h"
#include "drivers/simulated/pixel_faults.h"

namespace tubesight::drivers {

/// What stands between a camera and the box: a frame store that may hang, under the noise of a line
/// behind it, and a compressor.
class VideoSource {
 public:
  /// A new recording of so many pixels a frame.
  void begin(std::size_t pixels);

  /// Before a field is drawn: its lines still hold what was delivered last.
  void remember(const FieldPixels& field, core::Parity parity, const FieldFaults& faults);

  /// Puts in the place of what the camera sees what arrives. Call behind remember().
  void pass(const FieldPixels& field, core::Parity parity, const FieldFaults& faults, Dice& dice);

 private:
  [[nodiscard]] std::vector<std::uint8_t>& store(core::Parity parity) {
    return stores_[static_cast<std::size_t>(parity)];
  }

  std::array<std::vector<std::uint8_t>, 3> stores_;  ///< by parity: where a store hangs
  std::array<bool, 3> hangs_{};
  std::vector<std::uint8_t> before_;  ///< the field delivered last, for a compressor
};

}  // namespace tubesight::drivers
