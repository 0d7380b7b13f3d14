#pragma once

#include <cstdint>

#include "core/base/field.h"

namespace tubesight::hal {

/// Which light was commanded when: a lamp that is dimmed softly follows its level over many fields.
class LampHistory {
 public:
  /// The level in force at `instant` of the clock that stamps fields, 0 to kFullLevel_permille; for
  /// an instant before all that is remembered the oldest. Never waits; any thread.
  [[nodiscard]] virtual std::int32_t level_permille_at(core::FieldTime instant) const = 0;

 protected:
  ~LampHistory() = default;
};

}  // namespace tubesight::hal
