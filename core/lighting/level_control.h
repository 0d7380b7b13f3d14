#pragma once

#include <cstdint>

#include "core/base/field.h"
#include "core/lighting/lamp_policy.h"
#include "core/lighting/tube_light.h"

namespace tubesight::core::lighting {

/// Contrast that tube-ends have without anybody touching the light, 1/16 grey level: rims that
/// stand out, far from the camera's limit. Within these bounds nothing is done.
inline constexpr std::int32_t kDimContrast_q4 = 70 * 16;
inline constexpr std::int32_t kBrightContrast_q4 = 150 * 16;
/// What is led to once it is outside.
inline constexpr std::int32_t kWantedContrast_q4 = 105 * 16;

/// Sets the lamp's level by the contrast of the tube-ends that are tracked, and by how many of them
/// glare.
///
/// It does not hunt: nothing is done between the bounds; outside, the level goes to the middle by
/// 3 % in a tenth of a second at most and by less the nearer it is, slowly against a lamp's lag;
/// a level at which tube-ends glared is not gone above again until the light is another; and while
/// something else rules the lamp (a soft start, a bulb's rest) it waits. Without tube-ends the
/// level stays.
class LevelControl {
 public:
  void begin(std::int32_t permille);

  /// Takes a field with the level that was in force; gives the level wanted.
  std::int32_t follow(const Field& field, const TubeLightList& tubes, std::int32_t most_permille);

  [[nodiscard]] std::int32_t level_permille() const { return level_q10_ >> 10; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [level, due, contrast, fields, glaring, tubes, correcting, ceiling, ceiling_gain] = self;
    stream.number(level, 0, kFullLamp_permille << 10);
    stream(due);
    stream.number(contrast, 0, std::int64_t{1} << 40);
    stream.number(fields, 0, 1 << 20);
    stream.number(glaring, 0, 1 << 20);
    stream.number(tubes, 0, 1 << 20);
    stream.number(correcting, -1, 1);
    stream.number(ceiling, 0, kFullLamp_permille << 10);
    stream.number(ceiling_gain, 0, 1 << 30);
  }

 private:
  void step(std::int32_t contrast_q4, bool glares, std::int32_t most_q10);

  std::int32_t level_q10_ = kFullLamp_permille << 10;  ///< permille in 1/1024
  FieldTime due_{0};
  // Since the last step:
  std::int64_t contrast_sum_q4_ = 0;  ///< of the fields' means
  std::int32_t fields_ = 0;
  std::int32_t glaring_ = 0;  ///< tube-ends
  std::int32_t tubes_ = 0;

  std::int32_t correcting_ = 0;  ///< 1: to brighter, -1: to dimmer
  std::int32_t ceiling_q10_ = kFullLamp_permille << 10;
  std::int32_t ceiling_gain_ = 0;  ///< contrast in 1/16 that 1000 permille gave there
};

}  // namespace tubesight::core::lighting
