#pragma once

#include <cstdint>

namespace tubesight::tests {

/// The grey value that a fake camera draws: lines and columns can be told apart, and neighbours are
/// alike.
[[nodiscard]] constexpr std::uint8_t drawn_grey(std::int32_t u, std::int32_t v) {
  return static_cast<std::uint8_t>(40 + (u + 7 * v) % 160);
}

}  // namespace tubesight::tests
