#include "core/lighting/level_control.h"

#include <algorithm>
#include <cstdlib>

namespace tubesight::core::lighting {
namespace {

constexpr FieldTime kStep = std::chrono::milliseconds(100);
/// Where a correction ends: nearer to what is wanted than where it begins.
constexpr std::int32_t kDimEnough_q4 = 95 * 16;
constexpr std::int32_t kBrightEnough_q4 = 120 * 16;

constexpr std::int32_t gain_of(std::int32_t contrast_q4, std::int32_t level_q10) {
  return static_cast<std::int32_t>(std::int64_t{contrast_q4} * (kFullLamp_permille << 10) /
                                   std::max(level_q10, 1));
}

}  // namespace

void LevelControl::begin(std::int32_t permille) {
  *this = {};
  level_q10_ = permille << 10;
}

std::int32_t LevelControl::follow(const Field& field, const TubeLightList& tubes,
                                  std::int32_t most_permille) {
  const std::int32_t most_q10 = most_permille << 10;
  level_q10_ = std::min(level_q10_, most_q10);
  // Whoever else rules the lamp: what is seen then comes of another level.
  const std::int32_t off = std::abs(level_permille() - field.lamp_permille);
  if (!tubes.empty() && off * 10 <= level_permille()) {
    contrast_sum_q4_ += mean_light_q4(tubes);
    ++fields_;
    tubes_ += tubes.size();
    for (const TubeLight& tube : tubes) {
      glaring_ += tube.light_q4 >= kGlaring_q4 ? 1 : 0;
    }
  }
  const FieldTime late = field.mid_exposure - due_;
  if (late < FieldTime(0) && late > -kStep) {
    return level_permille();
  }
  due_ = field.mid_exposure + kStep;
  if (fields_ > 0) {
    step(static_cast<std::int32_t>(contrast_sum_q4_ / fields_), glaring_ * 4 > tubes_, most_q10);
  }
  contrast_sum_q4_ = 0;
  fields_ = glaring_ = tubes_ = 0;
  return level_permille();
}

void LevelControl::step(std::int32_t contrast_q4, bool glares, std::int32_t most_q10) {
  const std::int32_t gain = gain_of(contrast_q4, level_q10_);
  if (gain < ceiling_gain_ / 4 * 3) {
    ceiling_q10_ = kFullLamp_permille << 10;  // another place, another lamp
    ceiling_gain_ = 0;
  }
  const std::int32_t most_change = std::max(level_q10_ * 3 / 100, 1024);
  if (glares) {
    correcting_ = 0;
    level_q10_ = std::max(level_q10_ - most_change, kDimmest_permille << 10);
    ceiling_q10_ = level_q10_;
    ceiling_gain_ = gain;
    return;
  }
  if (contrast_q4 < kDimContrast_q4) {
    correcting_ = 1;
  } else if (contrast_q4 > kBrightContrast_q4) {
    correcting_ = -1;
  } else if ((correcting_ > 0 && contrast_q4 >= kDimEnough_q4) ||
             (correcting_ < 0 && contrast_q4 <= kBrightEnough_q4)) {
    correcting_ = 0;
  }
  if (correcting_ == 0) {
    return;
  }
  // A tenth of the way in a tenth of a second.
  const std::int64_t way = std::int64_t{level_q10_} * (kWantedContrast_q4 - contrast_q4) /
                           (10 * std::max(contrast_q4, 1));
  const auto change =
      static_cast<std::int32_t>(std::clamp<std::int64_t>(way, -most_change, most_change));
  const std::int32_t limit = std::min(most_q10, ceiling_q10_);
  level_q10_ = std::clamp(level_q10_ + change, kDimmest_permille << 10,
                          std::max(limit, kDimmest_permille << 10));
}

}  // namespace tubesight::core::lighting
