#include "core/lighting/pattern_gain.h"

#include <algorithm>
#include <array>

namespace tubesight::core::lighting {
namespace {

/// Fields that tell as much as one, as neighbouring differences share their fields; measured by
/// tests/benchmark/lamp_study.cpp.
constexpr std::int64_t kDependent = 2;
/// The same while the tool moves, as what the tube-ends' light does on the way is alike for some
/// fields, and more so over the longer span of a slow lamp. The tube-ends differ among themselves
/// then by more than half of what their mean leaves over.
constexpr std::array<std::int64_t, kSpans> kDependentMoving = {4, 8};
constexpr std::int64_t kOwnNoise = 2;
/// The same of another lamp with a pattern of such chips, and the most that it leaves over: a
/// swing larger than ours by the half.
constexpr std::int64_t kDependentOfAnother = 4;
constexpr std::int64_t kMostOfAnother = 2;
/// What noise leaves over is 6 / 2 of the scatter of a change, from theory, and at rest; less while
/// the tool moves. More where all light flickers: that is learnt.
constexpr std::int32_t kLeastRatio_q10 = 3 * 1024;
/// The fewer fields, the likelier is a correlation by chance: Student's distribution has tails.
/// Added to the deviations that are certain: 60 over the fields that tell of their own.
constexpr std::int64_t kTail_q4 = 60 * 16;
constexpr std::int64_t kFewestFields = 24;
/// A level that changes less (0.05 %) shows nothing.
constexpr std::int64_t kLeastSquare_q16 = 33 * 33;

}  // namespace

std::int64_t integer_root(std::int64_t value) {
  std::int64_t root = 0;
  for (std::int64_t bit = std::int64_t{1} << 30; bit > 0; bit >>= 1) {
    if ((root + bit) * (root + bit) <= value) {
      root += bit;
    }
  }
  return root;
}

void PatternSums::add(const PatternSums& other) {
  for (std::size_t span = 0; span < kSpans; ++span) {
    spans[span].count += other.spans[span].count;
    spans[span].uu += other.spans[span].uu;
    spans[span].scatter += other.spans[span].scatter;
  }
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    uv[lag] += other.uv[lag];
    vv[lag] += other.vv[lag];
  }
}

// Least squares of u = g v. What is left over, r = u - g v, says how well g is known: its variance
// is D mean(r^2) / sum(v^2), D being how many fields tell as much as one of their own. Against a
// picture that knows nothing of the lamp as much of r as another lamp with a pattern would make
// counts with that pattern's D. Against a sound lamp r counts up to what noise was learnt to leave,
// and below that the fewer fields say it, the less it is worth.
PatternGain gain_of(const PatternSums& sums, std::size_t lag, std::int32_t noise_ratio_q10) {
  PatternGain gain;
  const PatternSums::OfSpan& of_span = sums.spans[span_of(lag)];
  const std::int64_t count = of_span.count;
  if (count < kFewestFields || sums.vv[lag] < count * kLeastSquare_q16) {
    return gain;
  }
  const std::int64_t uu = of_span.uu >> 8;
  const std::int64_t uv = sums.uv[lag] >> 8;
  const std::int64_t vv = std::max<std::int64_t>(sums.vv[lag] >> 8, 1);
  const std::int64_t explained = uv * uv / vv;
  const std::int64_t rest = std::max<std::int64_t>(uu - explained, 0);
  constexpr std::int64_t kFar_q10 = 64 * 1024;
  gain.known = true;
  gain.q10 = static_cast<std::int32_t>(std::clamp(uv * 1024 / vv, -kFar_q10, kFar_q10));
  const auto deviation_q10 = [&](std::int64_t squares) {
    return static_cast<std::int32_t>(integer_root((squares << 20) / (count * vv))) + 1;
  };
  const std::int64_t scatter = of_span.scatter >> 8;
  const std::int64_t anothers =
      std::clamp<std::int64_t>(rest - scatter, 0, std::min(rest, kMostOfAnother * vv));
  const std::int64_t from_none = kDependent * (rest - anothers) + kDependentOfAnother * anothers;
  gain.from_none_q10 = deviation_q10(from_none);
  gain.tail_q4 =
      static_cast<std::int32_t>(kTail_q4 * from_none / (std::max<std::int64_t>(rest, 1) * count));
  const std::int64_t dependent =
      rest >= kOwnNoise * scatter ? kDependent : kDependentMoving[span_of(lag)];
  std::int64_t from_sound = dependent * rest;
  gain.sound_tail_q4 = static_cast<std::int32_t>(kTail_q4 * dependent / count);
  if (noise_ratio_q10 > 0) {
    const std::int64_t ratio_q10 = std::max(noise_ratio_q10, kLeastRatio_q10);
    const std::int64_t most = (scatter * ratio_q10 >> 10) * 3 / 2 + of_lag(vv);
    if (rest > most) {
      from_sound = kDependent * most;
      gain.sound_tail_q4 = 0;  // known, whatever these fields are like
    }
  }
  gain.from_sound_q10 = deviation_q10(from_sound);
  gain.count = count;
  gain.rest = rest;
  gain.all = uu;
  return gain;
}

std::int32_t PatternGain::above_q4(std::int32_t limit_q10) const {
  return known ? (q10 - limit_q10) * 16 / from_none_q10 : 0;
}

}  // namespace tubesight::core::lighting
