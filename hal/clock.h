#pragma once

#include "core/base/field.h"

namespace tubesight::hal {

/// The clock that stamps fields: what an instant of an event or of a field that never came is read
/// from.
///
/// Nobody below a board asks the system for the time; this is where it enters. Any thread.
class Clock {
 public:
  /// The present instant, on the same zero as Field::mid_exposure. Never runs backwards and never
  /// waits; it may stand still, as a recording's does between two fields. Without errors: a clock
  /// that can fail is not one.
  [[nodiscard]] virtual core::FieldTime now() const = 0;

 protected:
  ~Clock() = default;
};

}  // namespace tubesight::hal
