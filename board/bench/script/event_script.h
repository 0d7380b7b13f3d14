#pragma once

#include "core/base/event.h"
#include "core/base/field.h"

namespace tubesight::board {

/// Who asked what and when, written down beforehand: the events of a recording or a scenario.
///
/// The ports of a replay share one script, of which each hands out the next row only if it is its
/// own. So the loop gets the rows in the script's order, whoever said them.
class EventScript {
 public:
  virtual ~EventScript() = default;

  /// The next row that belongs before the field last grabbed, or earlier; null: none is left. Valid
  /// until the next call of the script or its grabber.
  [[nodiscard]] virtual const core::Event* next() = 0;

  /// The row that next() gave was handed over.
  virtual void take() = 0;

  /// Mid-exposure of the field last grabbed: the instant of a row without one of its own.
  [[nodiscard]] virtual core::FieldTime field_time() const = 0;
};

}  // namespace tubesight::board
