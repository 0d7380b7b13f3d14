#include "core/lighting/light_fall.h"

#include <algorithm>
#include <cstdlib>

namespace tubesight::core::lighting {
namespace {

/// Longer without a field of tube-ends, and nothing is followed any more.
constexpr FieldTime kPause = std::chrono::milliseconds(200);
/// A lag between an LED's and a bulb's: what it is wrong by is over when it counts.
constexpr std::int64_t kLag_us = 130'000;
/// Any lamp has followed its level by then.
constexpr FieldTime kSettled = std::chrono::seconds(2);
/// Expected light rises to what is seen in that time, and on the move falls to it in the other.
constexpr std::int64_t kRise_us = 2'000'000;
constexpr std::int64_t kForget_us = 20'000'000;

constexpr FieldTime kStillFor = std::chrono::milliseconds(500);
constexpr FieldTime kMovingFor = std::chrono::seconds(2);
constexpr FieldTime kBackFor = std::chrono::milliseconds(500);

// Shares of the light that are missing, 1/1024, and the same as sums of relative changes, 1/65536:
// -ln(1 - share).
constexpr std::int64_t kStillFall_q10 = 307;  // 30 %
constexpr std::int64_t kStillFall_q16 = 23'375;
constexpr std::int64_t kMovingFall_q10 = 410;  // 40 %
constexpr std::int64_t kMovingFall_q16 = 33'477;
constexpr std::int64_t kBack_q10 = 154;  // 15 %
/// With much other light the lamp's is looked for in half of these at least: shadows are as large.
constexpr std::int32_t kLeastShare_q10 = 512;
/// What is seen of a change of a level where nobody knows: cameras may show the root of it.
constexpr std::int32_t kUnknownShare_q10 = 512;

}  // namespace

/// By how much the level rose, led through a lag, 1/65536 of itself; a level that is far away is
/// not followed but taken.
std::int32_t LightFall::lead_level(const Field& field, FieldTime passed) {
  const std::int32_t level_q10 = field.lamp_permille << 10;
  const std::int32_t before_q10 = level_q10_;
  const std::int64_t passed_us = passed.count() / 1000;
  level_q10_ += static_cast<std::int32_t>(std::int64_t{level_q10 - level_q10_} * passed_us /
                                          (kLag_us + passed_us));
  const std::int64_t sum = std::max<std::int64_t>(std::int64_t{level_q10_} + before_q10, 1);
  return static_cast<std::int32_t>(std::int64_t{level_q10_ - before_q10} * 131'072 / sum);
}

void LightFall::follow(const Look& look) {
  const FieldTime now = look.field->mid_exposure;
  const FieldTime passed = now - last_;
  const bool goes_on = last_ >= FieldTime(0) && passed > FieldTime(0) && passed < kPause;
  if (look.tubes->empty()) {
    if (!fallen_) {
      begin();
    }
    return;
  }
  last_ = now;
  const std::int64_t light_q12 = std::int64_t{mean_light_q4(*look.tubes)} << 8;
  if (!goes_on) {
    level_q10_ = look.field->lamp_permille << 10;
  }
  const std::int32_t led_q16 = goes_on ? lead_level(*look.field, passed) : 0;
  const std::int32_t way = std::abs((look.field->lamp_permille << 10) - level_q10_);
  if (!goes_on || way > level_q10_ / 4) {
    settled_ = now + kSettled;  // a start, or somebody commands another level
  }
  if (!fallen_ && now < settled_) {
    expected_q12_ = light_q12;
    trail_q16_ = 0;
    since_ = FieldTime(-1);
    return;
  }
  const std::int64_t rise_q16 =
      std::int64_t{led_q16} * look.share_q10.value_or(kUnknownShare_q10) / 1024;
  // Each field's change is that since the last of its lines: half of it counts.
  const std::int64_t change_q16 =
      look.change ? std::clamp(look.change->mean_q16, -131'072, 131'072) / 2 - rise_q16 : 0;
  const std::int64_t passed_us = goes_on ? passed.count() / 1000 : 0;
  expected_q12_ =
      std::clamp<std::int64_t>(expected_q12_ + expected_q12_ * rise_q16 / 65'536, 1, kMostLight);
  trail_q16_ =
      static_cast<std::int32_t>(std::clamp<std::int64_t>(trail_q16_ + change_q16, -kMostTrail, 0));
  const std::int64_t way_q12 = light_q12 - expected_q12_;
  if (way_q12 > 0) {
    expected_q12_ += way_q12 * passed_us / kRise_us;
  } else if (!look.still && !fallen_) {
    expected_q12_ += way_q12 * passed_us / kForget_us;
    trail_q16_ -= static_cast<std::int32_t>(trail_q16_ * passed_us / kForget_us);
  }
  if (is_low(look, light_q12) == fallen_) {
    since_ = FieldTime(-1);
    return;
  }
  since_ = since_ < FieldTime(0) || now < since_ ? now : since_;
  const FieldTime enough = fallen_ ? kBackFor : look.still ? kStillFor : kMovingFor;
  if (now - since_ >= enough) {
    fallen_ = !fallen_;
    trail_q16_ = 0;
    since_ = FieldTime(-1);
  }
}

/// The lamp gives too little; of a lamp that gave too little, it still does.
bool LightFall::is_low(const Look& look, std::int64_t light_q12) const {
  if (fallen_) {
    return light_q12 * 1024 < expected_q12_ * (1024 - kBack_q10);
  }
  const std::int64_t share_q10 =
      look.still ? std::clamp(look.share_q10.value_or(1024), kLeastShare_q10, 1024) : 1024;
  const std::int64_t fall_q10 = (look.still ? kStillFall_q10 : kMovingFall_q10) * share_q10 / 1024;
  const std::int64_t trail_q16 = (look.still ? kStillFall_q16 : kMovingFall_q16) * share_q10 / 1024;
  return trail_q16_ < -trail_q16 && light_q12 * 1024 < expected_q12_ * (1024 - fall_q10);
}

}  // namespace tubesight::core::lighting
