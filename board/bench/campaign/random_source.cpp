#include "board/bench/campaign/random_source.h"

#include <cmath>
#include <numbers>

namespace tubesight::board::campaign {
namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;  // 2^64 / golden ratio, odd

// The finaliser of SplitMix64: every bit of the input changes every bit of the output evenly.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

}  // namespace

RandomSource::RandomSource(std::uint64_t seed, std::int64_t move, std::uint64_t topic)
    : key_(mixed(mixed(mixed(seed + kGolden) ^ static_cast<std::uint64_t>(move)) + topic)) {}

std::uint64_t RandomSource::bits() { return mixed(key_ + ++count_ * kGolden); }

double RandomSource::between(double low, double high) {
  constexpr double kPerBit = 1.0 / 9007199254740992.0;  // 2^-53
  return low + (high - low) * static_cast<double>(bits() >> 11U) * kPerBit;
}

std::int32_t RandomSource::whole(std::int32_t low, std::int32_t high) {
  const auto count = static_cast<std::uint64_t>(std::int64_t{high} - low + 1);
  // The remainder favours small numbers by count / 2^64: nothing for the ranges in use.
  return low + static_cast<std::int32_t>(bits() % count);
}

double RandomSource::normal(double deviation) {
  constexpr double kMost = 3.0;
  double value = kMost + 1.0;
  while (std::abs(value) > kMost) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - between(0.0, 1.0)));
    value = radius * std::cos(2.0 * std::numbers::pi * between(0.0, 1.0));
  }
  return value * deviation;
}

bool RandomSource::chance(double probability) { return between(0.0, 1.0) < probability; }

}  // namespace tubesight::board::campaign
