#include "core/detection/verdict.h"

#include <algorithm>

namespace tubesight::core::detection {
namespace {

// All limits here lie between what was measured of open tube-ends, plugs, bare sheet and places
// behind the guidetube in the campaign's frames of seeds 1 to 6 (docs/accuracy.md).

/// How alike a place has to be. What is small is blurred, and a plug with a hole in it is more like
/// a tube-end then.
double least_alike(double half_px) {
  constexpr double kTiny_px = 6.5;
  constexpr double kLarge_px = 20.0;
  if (half_px < kTiny_px) {
    return 0.88;
  }
  return half_px > kLarge_px ? 0.63 : std::clamp(0.58 + 0.08 * (10.0 - half_px), 0.58, 0.78);
}

bool is_alike(const Resemblance& whole, const HalfResemblance& half, double half_px) {
  constexpr double kLeastSeen = 0.6;
  constexpr double kLeastSigmas = 5.0;
  constexpr double kLeastDepth = 0.37;  // below, the ring of a flush plug
  constexpr double kMostDepth = 1.6;
  // Half of a rolled plug's face is a step deeper than a tube-end's slope.
  constexpr double kSmall_px = 12.0;
  const double most_half_depth = half_px < kSmall_px ? 1.5 : 2.5;
  constexpr double kVeryAlike = 0.87;
  // Something dark beside it is its neighbours' weld's shadow, or a plug's.
  constexpr double kLarge_px = 20.0;
  constexpr double kLeastEvenness = 0.7;
  constexpr double kLeastEvennessAlike = 0.45;
  const double most_shift_px = std::max(2.5, 0.15 * half_px);
  const bool very = whole.without_noise > kVeryAlike;
  return whole.seen > kLeastSeen && whole.sigmas > kLeastSigmas &&
         whole.without_noise > least_alike(half_px) && whole.depth > kLeastDepth &&
         whole.depth < kMostDepth && (very || half.depth < most_half_depth) &&
         whole.shift_px.norm() <= most_shift_px &&
         (half_px > kLarge_px || whole.evenness > (very ? kLeastEvennessAlike : kLeastEvenness));
}

bool is_half_hidden(const Resemblance& whole, const HalfResemblance& half) {
  constexpr double kLeastSeen = 0.9;
  constexpr double kLeastAlike = 0.3;
  constexpr double kMostEvenness = 0.5;  // what hides it is darker than the sheet, or lighter
  constexpr double kLeastDepth = 0.7;
  return whole.seen > kLeastSeen && whole.alike > kLeastAlike && whole.evenness < kMostEvenness &&
         half.depth > kLeastDepth &&
         ((half.alike > 0.885 && half.depth < 1.3) || (half.alike > 0.95 && half.depth < 1.8));
}

bool is_plug(const Resemblance& whole, const HalfResemblance& half, bool edgeless) {
  const bool stepped = half.depth > 1.7 && whole.without_noise < 0.87 && half.alike < 0.87;
  const bool small = edgeless && half.depth > 1.5 && whole.without_noise < 0.9;
  return stepped || small;
}

bool is_nothing(const Resemblance& whole, const HalfResemblance& half) {
  return whole.without_noise < 0.5 && half.alike < 0.75;
}

}  // namespace

Verdict judge(const Resemblance& whole, const HalfResemblance& half, double half_px,
              bool edgeless) {
  if (is_alike(whole, half, half_px)) {
    return Verdict::kAlike;
  }
  if (is_half_hidden(whole, half)) {
    return Verdict::kHidden;
  }
  constexpr double kLeastSeen = 0.6;
  if (whole.seen > kLeastSeen) {
    if (is_plug(whole, half, edgeless)) {
      return Verdict::kPlug;
    }
    if (is_nothing(whole, half)) {
      return Verdict::kNone;
    }
  }
  return Verdict::kUnsure;
}

}  // namespace tubesight::core::detection
