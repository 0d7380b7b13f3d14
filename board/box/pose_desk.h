#pragma once

#include <cstdint>
#include <optional>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"

namespace tubesight::board {

/// Where the loop leaves orders for poses, and finds what became of them.
class PoseDesk {
 public:
  /// Takes a field that was stepped, and the order that the step left. The field's pixels are valid
  /// until the call returns.
  virtual void take(const core::Field& field, std::int64_t number,
                    const core::PoseOrder& order) = 0;

  /// The event to hand over before the next field, once.
  [[nodiscard]] virtual std::optional<core::Event> take_result() = 0;

 protected:
  ~PoseDesk() = default;
};

}  // namespace tubesight::board
