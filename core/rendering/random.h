#pragma once

#include <cstdint>

namespace tubesight::core::rendering {

/// Thoroughly mixed bits of `value`: the finaliser of splitmix64 after its step. The renderer's
/// randomness is a function of counters, so that nothing depends on the order of drawing.
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15U;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31);
}

/// Bits for a pair of counters under a seed; `what` tells uses of the same pair apart.
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t seed, std::int32_t a, std::int32_t b,
                                            std::uint32_t what) {
  const std::uint64_t pair = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) |
                             static_cast<std::uint32_t>(b);
  return mixed(mixed(mixed(seed) ^ pair) + what);
}

/// 0 <= share < 1 from mixed bits.
[[nodiscard]] constexpr double share_of(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// A number of mean 0 and sigma 1, nearly normal and never beyond 3.5: the sum of four uniform
/// ones.
[[nodiscard]] constexpr double bounded_normal(std::uint64_t bits) {
  double sum = 0.0;
  for (int part = 0; part < 4; ++part) {
    sum += static_cast<double>((bits >> (16 * part)) & 0xffffU) + 0.5;
  }
  constexpr double kRootThree = 1.7320508075688772;
  return (sum / 65536.0 - 2.0) * kRootThree;
}

}  // namespace tubesight::core::rendering
