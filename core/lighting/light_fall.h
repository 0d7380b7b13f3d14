#pragma once

#include <cstdint>
#include <optional>

#include "core/base/field.h"
#include "core/lighting/brightness_trail.h"
#include "core/lighting/tube_light.h"

namespace tubesight::core::lighting {

/// Whether the lamp gives clearly less light than its level gave before, however slowly it fades.
///
/// Two things must say so. The tube-ends in view became darker while they were in view, by more
/// than the level did: that tells a lamp from a part of the sheet that is darker. And they are
/// darker than the ones seen before were at such a level: that tells it from a tool that passes
/// tube-ends from the bright side of its light to the dim one. At rest, where both are one and the
/// same, by 30 % of the lamp's light for half a second; on the move by 40 % for two seconds, and
/// both are slowly forgotten there, in 20 s.
class LightFall {
 public:
  void begin() { *this = {}; }

  /// What one field shows.
  struct Look {
    const Field* field = nullptr;
    std::optional<LightChange> change;     ///< of the tube-ends since the last field of such lines
    const TubeLightList* tubes = nullptr;  ///< empty: none are known
    bool still = false;                    ///< the tool rests
    /// Of a change of the level that much is seen, 1/1024; empty: nobody knows.
    std::optional<std::int32_t> share_q10;
  };
  void follow(const Look& look);

  /// From then on until 85 % are there again.
  [[nodiscard]] bool fallen() const { return fallen_; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [last, settled, level, trail, expected, since, fallen] = self;
    stream(last, settled);
    stream.number(level, 0, kFullLamp_permille << 10);
    stream.number(trail, -kMostTrail, kMostTrail);
    stream.number(expected, 0, kMostLight);
    stream(since, fallen);
  }

 private:
  static constexpr std::int32_t kMostTrail = 1 << 20;
  static constexpr std::int64_t kMostLight = 1 << 28;

  std::int32_t lead_level(const Field& field, FieldTime passed);
  [[nodiscard]] bool is_low(const Look& look, std::int64_t light_q12) const;

  FieldTime last_{-1};
  FieldTime settled_{0};           ///< from then on the lamp shines as its level says
  std::int32_t level_q10_ = 0;     ///< led through a lamp's lag, permille in 1/1024
  std::int32_t trail_q16_ = 0;     ///< sum of changes, less those of the level
  std::int64_t expected_q12_ = 0;  ///< light at this level, 1/4096 grey level
  FieldTime since_{-1};            ///< it is as the other answer would be; below 0: it is not
  bool fallen_ = false;
};

}  // namespace tubesight::core::lighting
