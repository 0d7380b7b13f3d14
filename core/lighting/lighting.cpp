#include "core/lighting/lighting.h"

#include <algorithm>
#include <cstdlib>

namespace tubesight::core::lighting {
namespace {

/// A lamp of this level and more is to be seen.
constexpr std::int32_t kBrightLevel_permille = 200;
constexpr std::int32_t kDark_q4 = 24 * 16;  // black levels and noise stay below
constexpr FieldTime kDarkFor = std::chrono::seconds(1);
/// Of a lamp that does all it may; the light is led up long before.
constexpr std::int32_t kWeakContrast_q4 = kDimContrast_q4 * 2 / 3;
/// A light that falls by 30 % in a fifth of a second; a tool at 300 mm/s makes a tenth of it.
constexpr std::int32_t kBreakdown_q16 = 19'660;
/// A lamp has followed its level by then.
constexpr FieldTime kFollowed = std::chrono::seconds(2);
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
  breakdown_ = {};
  fall_.begin();
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
  const std::optional<LightChange> change = trail_.follow(field, lights_);
  watch_.follow(field, change);
  breakdown_.follow(field, change ? std::optional(change->mean_q16) : std::nullopt);
  watch_lamp(field, look.knows_place);
  if (!look.knows_place) {
    lights_.clear();  // no tube-ends
  }
  fall_.follow({&field, change, &lights_, look.still, watch_.share_q10()});
  if (watch_.wants_level()) {
    return;  // the picture may be another lamp's
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

void Lighting::Breakdown::follow(const Field& field, std::optional<std::int32_t> change_q16) {
  const std::int32_t off = std::abs(field.lamp_permille - level_permille_);
  if (off * 20 > level_permille_ || field.mid_exposure < steady_since_) {
    level_permille_ = field.lamp_permille;
    steady_since_ = field.mid_exposure;
  }
  // Each field's change is that since the last of its lines: half of it counts.
  fall_q16_ = change_q16 ? fall_q16_ * 11 / 12 + std::clamp(*change_q16, -65'536, 65'536) / 2 : 0;
  const FieldTime steady = field.mid_exposure - steady_since_;
  if (steady >= kFollowed && fall_q16_ < -kBreakdown_q16) {
    broken_ = true;
  } else if (fall_q16_ > kBreakdown_q16) {
    broken_ = false;
  }
}

void Lighting::watch_lamp(const Field& field, bool knows_place) {
  if (knows_place && lights_.empty()) {
    return;  // passed over: nobody knows
  }
  const std::int32_t light_q4 = mean_light_q4(lights_);
  const bool should_shine = field.lamp_permille >= kBrightLevel_permille;
  dark_.follow(!knows_place && should_shine && light_q4 < kDark_q4, field.mid_exposure, kDarkFor);
  const bool does_all = field.lamp_permille * 20 >= policy_.most_permille * 19;
  if (light_q4 >= kDimContrast_q4) {
    breakdown_.clear();
  }
  weak_.follow(knows_place && does_all && light_q4 < kWeakContrast_q4, field.mid_exposure,
               kWeakFor);
}

std::int32_t Lighting::wanted_permille(std::optional<std::int32_t> commanded, FieldTime now) {
  const std::int32_t own =
      policy_.follows_picture ? control_.level_permille() : policy_.most_permille;
  const std::int32_t level = std::min(commanded.value_or(own), policy_.most_permille);
  if (!policy_.pattern) {
    return level;
  }
  const std::int32_t share = watch_.needs_wide_swing() ? kWideSwing_permille : kSwing_permille;
  return swung_permille(level, pattern_.sign_after(now), share, policy_.most_permille);
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
  if (weak_.long_enough || breakdown_.broken() || fall_.fallen()) {
    return LampCondition::kWeak;
  }
  return watch_.liveness() == Liveness::kProved ? LampCondition::kWell : LampCondition::kUnknown;
}

}  // namespace tubesight::core::lighting
