#pragma once

#include <cstdint>

#include "core/base/field.h"

namespace tubesight::core::lighting {

/// How long a level of the pattern is held: some fields, as a lamp follows with a lag.
inline constexpr FieldTime kChip = std::chrono::milliseconds(50);

/// How far the level swings to either side: as little as a lamp needs that is seen to follow soon,
/// and the most, until that is seen and of a lamp that follows so slowly that a quarter of it is
/// left.
inline constexpr std::int32_t kSwing_permille = 10;
inline constexpr std::int32_t kWideSwing_permille = 20;

/// The order of brighter and dimmer that a lamp's level swings in: the bits of a shift register
/// with feedback [x^31 + x^28 + 1], which come back after 3.4 years of 50 ms each. Boxes begin it
/// at places of their own.
class LampPattern {
 public:
  /// From the next field on, at a place that `seed` tells.
  void begin(std::uint32_t seed);

  /// The sign of the swing wanted after a field of this instant.
  [[nodiscard]] std::int32_t sign_after(FieldTime now);

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [bits, until] = self;
    stream.number(bits, 1U, 0x7FFF'FFFFU);
    stream(until);
  }

 private:
  std::uint32_t register_ = 1;  ///< 31 bits, never 0
  FieldTime until_{0};          ///< the next bit is due
};

/// A level and its swing to one side, `share_permille` of it. Below kDimmest_permille nothing
/// swings. Where the swing would pass `most_permille` both sides are that much lower.
[[nodiscard]] std::int32_t swung_permille(std::int32_t permille, std::int32_t sign,
                                          std::int32_t share_permille, std::int32_t most_permille);

}  // namespace tubesight::core::lighting
