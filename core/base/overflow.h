#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/base/assert.h"

namespace tubesight::core {

/// Says whether a fixed-point number left its range on this thread since the flag was last taken.
///
/// Saturated numbers are wrong numbers: the session takes the flag after every field and an answer
/// made with it raised is not given.
[[nodiscard]] bool take_overflow_flag();

/// Raises the flag; called by the saturating policy.
void raise_overflow_flag();

/// Overflow policy of the product: the nearest representable number, and the sticky flag.
struct SaturateSticky {
  [[nodiscard]] static constexpr std::int32_t too_large() {
    note();
    return std::numeric_limits<std::int32_t>::max();
  }
  [[nodiscard]] static constexpr std::int32_t too_small() {
    note();
    return std::numeric_limits<std::int32_t>::min();
  }

 private:
  static constexpr void note() {
    if (!std::is_constant_evaluated()) {
      raise_overflow_flag();
    }
  }
};

/// Overflow policy for tests: leaving the range is a failed assertion.
struct TrapOnOverflow {
  [[nodiscard]] static std::int32_t too_large() {
    TUBESIGHT_ASSERT(!"fixed-point number above its range");
    return 0;
  }
  [[nodiscard]] static std::int32_t too_small() {
    TUBESIGHT_ASSERT(!"fixed-point number below its range");
    return 0;
  }
};

}  // namespace tubesight::core
