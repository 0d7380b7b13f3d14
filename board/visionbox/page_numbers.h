#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace tubesight::board {

// Numbers as the page is told them: seconds, millimetres, no more digits than mean something.

[[nodiscard]] inline double seconds(std::chrono::nanoseconds time) {
  return static_cast<double>(time.count()) / 1e9;
}

[[nodiscard]] inline double mm(std::int64_t um_q8) {
  return static_cast<double>(um_q8) / 256'000.0;
}

/// To the nearest of so many steps per unit: 12.345, not 12.345000000000001.
[[nodiscard]] inline double rounded(double value, double per_unit) {
  return std::round(value * per_unit) / per_unit;
}

}  // namespace tubesight::board
