#pragma once

#include <cstdint>

namespace tubesight::drivers {

/// Random numbers that are the same on every machine: SplitMix64 (Steele, Lea and Flood, 2014).
class Dice {
 public:
  explicit constexpr Dice(std::uint64_t seed) : state_(seed) {}

  /// 64 random bits.
  constexpr std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t bits = state_;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBU;
    return bits ^ (bits >> 31);
  }

  /// Evenly in [0, 1): 53 random bits.
  constexpr double share() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

  /// Evenly in [least, most).
  constexpr double between(double least, double most) { return least + (most - least) * share(); }

 private:
  std::uint64_t state_;
};

/// A seed for part `index` of what `seed` began: neighbours are independent.
[[nodiscard]] constexpr std::uint64_t derived_seed(std::uint64_t seed, std::uint64_t index) {
  return Dice(seed ^ (index * 0xD1B54A32D192ED03U + 0x8BB84B93962EACC9U)).next();
}

}  // namespace tubesight::drivers
