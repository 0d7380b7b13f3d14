#pragma once

#include <concepts>
#include <cstdint>

#include "core/base/scalar.h"

namespace tubesight::core {

/// Never defined: a constant expression cannot call it, and so what does is refused.
void constant_does_not_fit();

/// A constant of the path, written as what it is: `constant<M>(0.4)`.
///
/// The compiler evaluates it; no floating point is left in the code. All kinds of arithmetic hold
/// the very same number, the multiple of 1/2^kBits nearest to the value (1/1024 by default), so
/// that double stays the oracle of fixed point: 0.4 is 410/1024 everywhere. Where more bits matter,
/// `constant<M, 16>(...)`. What would be rounded to 0 or leaves the format does not compile.
template <typename T, int kBits = 10>
[[nodiscard]] consteval T constant(double value) {
  const double scaled = value * static_cast<double>(std::int64_t{1} << kBits);
  const auto steps = static_cast<std::int64_t>(scaled + (scaled < 0.0 ? -0.5 : 0.5));
  if (steps == 0 && (value < 0.0 || value > 0.0)) {
    constant_does_not_fit();
  }
  if constexpr (!std::floating_point<T>) {
    const auto limit = static_cast<double>(std::int64_t{1} << (31 - T::kFractionBits));
    if (value >= limit || value < -limit) {
      constant_does_not_fit();
    }
  }
  return from_scaled<T>(steps, kBits);
}

}  // namespace tubesight::core
