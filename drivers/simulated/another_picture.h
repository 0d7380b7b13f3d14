#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/base/field.h"
#include "core/base/settings.h"
#include "core/rendering/exposure.h"
#include "drivers/simulated/fault_schedule.h"

namespace tubesight::drivers {

/// Another toolhead's lamp.
struct AnotherLamp {
  double following = 1.0;  ///< of the way to a new level that it goes in one field
  double swing = 0.01;     ///< to either side, of its level
};

/// What a frozen store shows, and another toolhead that rests when the fault begins: there a box
/// swings its lamp as this one does, by dice of its own.
class AnotherPicture {
 public:
  void begin() { *this = {}; }

  /// Puts it in the place of what the camera would see of `sheet`, where `faults` say so. Call for
  /// each field.
  void show(const core::Field& field, const FieldFaults& faults,
            const core::TubesheetSettings& sheet, const AnotherLamp& lamp, std::uint64_t seed,
            core::rendering::Exposure& exposure);

 private:
  std::array<std::optional<core::rendering::Exposure>, 3> held_{};  ///< by parity
  double swing_ = 0.0;                                              ///< of the other lamp
};

}  // namespace tubesight::drivers
