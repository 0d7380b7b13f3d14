#pragma once

#include <cstdint>

namespace tubesight::board::campaign {

/// Random numbers by counting: the n-th number is a hash of (seed, move, topic, n).
///
/// Nothing is carried over from move to move, so any move can be drawn alone, in any order and on
/// any thread. Each topic (plant, camera, path ...) has numbers of its own: drawing one more there
/// leaves the others as they were.
class RandomSource {
 public:
  RandomSource(std::uint64_t seed, std::int64_t move, std::uint64_t topic);

  /// 64 even bits.
  [[nodiscard]] std::uint64_t bits();
  /// Even in [low, high).
  [[nodiscard]] double between(double low, double high);
  /// Even among low, low + 1 ... high.
  [[nodiscard]] std::int32_t whole(std::int32_t low, std::int32_t high);
  /// Normal, mean 0; cut off at three `deviation`s, as measured and sorted things are.
  [[nodiscard]] double normal(double deviation);
  /// True in a share of `probability` of all draws.
  [[nodiscard]] bool chance(double probability);

 private:
  std::uint64_t key_;
  std::uint64_t count_ = 0;
};

}  // namespace tubesight::board::campaign
