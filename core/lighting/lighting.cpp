#include "core/lighting/lighting.h"

#include <algorithm>

namespace tubesight::core::lighting {
namespace {

/// A lamp of this level and more is to be seen.
constexpr std::int32_t kBrightLevel_permille = 200;
constexpr std::int32_t kDark_q4 = 24 * 16;  // black levels and noise stay below
constexpr FieldTime kDarkFor = std::chrono::seconds(1);
/// Of a lamp that does all it may; the light is led up long before.
constexpr std::int32_t kWeakContrast_q4 = kDimContrast_q4 * 2 / 3;
constexpr FieldTime kWeakFor = std::chrono::milliseconds(1500);

}  // namespace

void Lighting::take(const LampPolicy& policy) {
  policy_ = policy;
  policy_.most_permille = std::clamp(policy.most_permille, kDimmest_permille, kFullLamp_permille);
  pattern_.begin(policy_.seed);
  control_.begin(policy_.most_permille);
  trail_.begin();
  watch_.begin();
  dark_ = {};
  weak_ = {};
}

void Lighting::look(const Look& look) {
  const Field& field = *look.field;
  if (!rules() || field.status != FieldStatus::kGood) {
    return;
  }
  if (look.knows_place) {
    list_tube_light(look.tubes, lights_);
  } else {
    list_window_light(field.pixels, look.window, lights_);
  }
  watch_.follow(field, trail_.follow(field, lights_));
  watch_lamp(field, look.knows_place);
  if (!look.knows_place) {
    lights_.clear();  // no tube-ends
  }
  static_cast<void>(control_.follow(field, lights_, policy_.most_permille));
}

void Lighting::Lasting::follow(bool so, FieldTime now, FieldTime enough) {
  if (!so) {
    *this = {};
    return;
  }
  since = since < FieldTime(0) || now < since ? now : since;
  long_enough = now - since >= enough;
}

void Lighting::watch_lamp(const Field& field, bool knows_place) {
  if (knows_place && lights_.empty()) {
    return;  // passed over: nobody knows
  }
  const std::int32_t light_q4 = mean_light_q4(lights_);
  const bool should_shine = field.lamp_permille >= kBrightLevel_permille;
  dark_.follow(!knows_place && should_shine && light_q4 < kDark_q4, field.mid_exposure, kDarkFor);
  const bool does_all = field.lamp_permille * 20 >= policy_.most_permille * 19;
  weak_.follow(knows_place && does_all && light_q4 < kWeakContrast_q4, field.mid_exposure,
               kWeakFor);
}

std::int32_t Lighting::wanted_permille(std::optional<std::int32_t> commanded, FieldTime now) {
  const std::int32_t own =
      policy_.follows_picture ? control_.level_permille() : policy_.most_permille;
  const std::int32_t level = std::min(commanded.value_or(own), policy_.most_permille);
  return policy_.pattern ? swung_permille(level, pattern_.sign_after(now), policy_.most_permille)
                         : level;
}

LampCondition Lighting::condition() const {
  if (!rules()) {
    return LampCondition::kUnknown;
  }
  if (dark_.long_enough) {
    return LampCondition::kDark;
  }
  if (watch_.liveness() == Liveness::kFailed) {
    return LampCondition::kUnseen;
  }
  if (weak_.long_enough) {
    return LampCondition::kWeak;
  }
  return watch_.liveness() == Liveness::kProved ? LampCondition::kWell : LampCondition::kUnknown;
}

}  // namespace tubesight::core::lighting
