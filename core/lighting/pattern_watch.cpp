#include "core/lighting/pattern_watch.h"

#include <algorithm>
#include <cstdlib>

namespace tubesight::core::lighting {
namespace {

/// From field to field of a second difference: 67 ms of the usual 60 fields a second.
constexpr FieldTime kSpan = std::chrono::milliseconds(60);
/// Both halves are of one length.
constexpr FieldTime kUneven = std::chrono::milliseconds(8);
/// What changes faster than this is on its way elsewhere: a soft start, a new level, another place.
constexpr std::int32_t kMostChange_q16 = 3277;  // 5 %
constexpr FieldTime kBlock = std::chrono::milliseconds(250);
/// Longer without a field, and nothing is led through a lag any more.
constexpr FieldTime kPause = std::chrono::milliseconds(500);

/// Fields that tell as much as one, as neighbouring differences share their fields; measured by
/// tests/benchmark/lamp_study.cpp.
constexpr std::int64_t kDependent = 2;
constexpr std::int64_t kFewestFields = 24;
/// A level that changes less (0.05 %) shows nothing.
constexpr std::int64_t kLeastSquare_q16 = 33 * 33;

/// While nothing was proved: what other light may leave to the lamp.
constexpr std::int32_t kLeastGain_q10 = 123;  // 12 %
// Deviations that are certain, in 1/16. Each answer is as far from what the other would show as
// false alarms are to be rare, and on its own side of the limit between them.
constexpr std::int32_t kFirstFromNone_q4 = 5 * 16;  // the lag is chosen among several
constexpr std::int32_t kFromNone_q4 = 9 * 16 / 2;   // proved: a picture that knows nothing, g = 0
constexpr std::int32_t kFromSound_q4 = 6 * 16;      // failed: a sound lamp, g as learnt
constexpr std::int32_t kAboveLimit_q4 = 16;
constexpr std::int32_t kFirstAboveLimit_q4 = 2 * 16;
constexpr std::int32_t kBelowLimit_q4 = 5 * 16 / 2;
constexpr std::int32_t kFirstBelowLimit_q4 = 4 * 16;
constexpr std::int32_t kMostUndecided = 40;  // blocks: 10 s

constexpr std::int64_t integer_root(std::int64_t value) {
  std::int64_t root = 0;
  for (std::int64_t bit = std::int64_t{1} << 30; bit > 0; bit >>= 1) {
    if ((root + bit) * (root + bit) <= value) {
      root += bit;
    }
  }
  return root;
}

}  // namespace

void PatternWatch::begin() {
  led_ = false;
  chain_ = {};
  chains_ = 0;
  next_moment_ = 0;
  moments_.fill({});
  now_ = {};
  block_until_ = FieldTime(0);
  blocks_.fill({});
  next_block_ = 0;
  learnt_lag_ = -1;
  liveness_ = Liveness::kUnknown;
  undecided_ = 0;
  score_q4_ = 0;
}

void PatternWatch::follow(const Field& field, std::optional<std::int32_t> change_q16) {
  const FieldTime passed = field.mid_exposure - last_;
  last_ = field.mid_exposure;
  level_permille_ = field.lamp_permille;
  const std::int32_t level_q16 = field.lamp_permille << 16;
  led_ = led_ && passed > FieldTime(0) && passed < kPause;
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    const std::int64_t passed_us = passed.count() / 1000;
    const std::int64_t way = std::int64_t{level_q16} - level_q16_[lag];
    level_q16_[lag] = led_ ? static_cast<std::int32_t>(
                                 level_q16_[lag] + way * passed_us / (kLags_us[lag] + passed_us))
                           : level_q16;
  }
  led_ = true;
  const std::size_t lines = field.parity == Parity::kOdd ? 0 : 1;
  const bool goes_on =
      change_q16 && chain_[lines] != 0 && std::abs(light_q16_[lines]) < kMostLight / 2;
  if (!goes_on) {
    chains_ = chains_ < kMostChains ? chains_ + 1 : 1;
    chain_[lines] = chains_;
    light_q16_[lines] = 0;
  } else {
    light_q16_[lines] += std::clamp(*change_q16, -kMostLight / 2, kMostLight / 2);
  }
  const Moment moment{field.mid_exposure, chain_[lines], light_q16_[lines], level_q16_};
  if (goes_on) {
    sample(moment);
  }
  moments_[next_moment_ % kMoments] = moment;
  ++next_moment_;
  if (field.mid_exposure >= block_until_ || field.mid_exposure + kBlock < block_until_) {
    block_until_ = field.mid_exposure + kBlock;
    close_block();
  }
}

/// The last moment of the same chain that is kSpan older, looked for from `place` on backwards.
const PatternWatch::Moment* PatternWatch::before(const Moment& moment, std::uint32_t& place) const {
  for (std::uint32_t back = 1; back <= kMoments; ++back) {
    const Moment& then = moments_[(place - back) % kMoments];
    if (then.chain == moment.chain && moment.at - then.at >= kSpan) {
      place -= back;
      return &then;
    }
  }
  return nullptr;
}

void PatternWatch::sample(const Moment& now) {
  std::uint32_t place = next_moment_;
  const Moment* const middle = before(now, place);
  const Moment* const first = middle != nullptr ? before(*middle, place) : nullptr;
  if (first == nullptr) {
    return;
  }
  const FieldTime uneven = (now.at - middle->at) - (middle->at - first->at);
  if (uneven > kUneven || uneven < -kUneven) {
    return;
  }
  const std::int64_t u = std::clamp(now.light_q16 - 2 * middle->light_q16 + first->light_q16,
                                    -kMostChange_q16, kMostChange_q16);
  std::array<std::int64_t, kLags> v{};
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    const std::int64_t level = middle->level_q16[lag];
    const std::int64_t bend = now.level_q16[lag] - 2 * level + first->level_q16[lag];
    v[lag] = level > 0 ? bend * 65'536 / level : kMostChange_q16 + 1;
    if (v[lag] > kMostChange_q16 || v[lag] < -kMostChange_q16) {
      return;
    }
  }
  ++now_.count;
  now_.uu += u * u;
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    now_.uv[lag] += u * v[lag];
    now_.vv[lag] += v[lag] * v[lag];
  }
}

void PatternWatch::Sums::add(const Sums& other) {
  count += other.count;
  uu += other.uu;
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    uv[lag] += other.uv[lag];
    vv[lag] += other.vv[lag];
  }
}

PatternWatch::Sums PatternWatch::sum_of(std::int32_t blocks) const {
  Sums sums;
  for (std::uint32_t back = 1; back <= static_cast<std::uint32_t>(blocks); ++back) {
    sums.add(blocks_[(next_block_ - back) % kBlocks]);
  }
  return sums;
}

void PatternWatch::close_block() {
  blocks_[next_block_ % kBlocks] = now_;
  ++next_block_;
  now_ = {};
  score_q4_ = 0;
  // The shortest time that is enough to be certain.
  Liveness told = Liveness::kUnknown;
  for (const std::int32_t blocks : {kShortBlocks, kMiddleBlocks, kBlocks}) {
    told = judge(sum_of(blocks));
    if (told != Liveness::kUnknown) {
      break;
    }
  }
  hold(told);
  if (liveness_ == Liveness::kProved && undecided_ == 0) {
    learn(sum_of(kBlocks));
  }
}

// Least squares of u = g v: the rest's mean square over that of v is the square of g's deviation,
// over the number of fields that tell something of their own.
PatternWatch::Gain PatternWatch::gain_of(const Sums& sums, std::size_t lag) {
  Gain gain;
  if (sums.count < kFewestFields || sums.vv[lag] < sums.count * kLeastSquare_q16) {
    return gain;
  }
  const std::int64_t uu = sums.uu >> 8;
  const std::int64_t uv = sums.uv[lag] >> 8;
  const std::int64_t vv = std::max<std::int64_t>(sums.vv[lag] >> 8, 1);
  const std::int64_t explained = uv * uv / vv;
  const std::int64_t rest = std::max<std::int64_t>(uu - explained, 0);
  constexpr std::int64_t kMostGain_q10 = 64 * 1024;
  gain.known = true;
  gain.q10 = static_cast<std::int32_t>(std::clamp(uv * 1024 / vv, -kMostGain_q10, kMostGain_q10));
  const std::int64_t square_q20 = kDependent * rest * (1 << 20) / (sums.count * vv);
  gain.sigma_q10 = static_cast<std::int32_t>(integer_root(square_q20)) + 1;
  gain.likeness_q10 = static_cast<std::int32_t>(uu > 0 ? std::min(explained, uu) * 1024 / uu : 0);
  return gain;
}

std::int32_t PatternWatch::Gain::above_q4(std::int32_t limit_q10) const {
  return known ? (q10 - limit_q10) * 16 / sigma_q10 : 0;
}

// Half of what is expected. Light that is not the lamp's stays when the lamp is dimmed:
// g = k L / (a + k L), and a / k was learnt with another level L.
std::int32_t PatternWatch::limit_q10() const {
  const std::int64_t lamp = std::int64_t{learnt_gain_q10_} * level_permille_;
  const std::int64_t other = std::int64_t{1024 - learnt_gain_q10_} * learnt_at_permille_;
  const std::int64_t expected = lamp + other > 0 ? lamp * 1024 / (lamp + other) : 0;
  return std::max(static_cast<std::int32_t>(expected / 2), kLeastGain_q10);
}

Liveness PatternWatch::judge(const Sums& sums) {
  const Liveness unlearnt = judge_unlearnt(sums);
  if (learnt_lag_ < 0) {
    return unlearnt;
  }
  const Gain gain = gain_of(sums, static_cast<std::size_t>(learnt_lag_));
  const std::int32_t limit = limit_q10();
  const std::int32_t above = gain.above_q4(limit);
  const std::int32_t from_sound = gain.above_q4(2 * limit);
  score_q4_ = std::min(score_q4_, from_sound);
  if (unlearnt == Liveness::kProved ||
      (gain.above_q4(0) >= kFromNone_q4 && above >= kAboveLimit_q4)) {
    return Liveness::kProved;
  }
  return from_sound <= -kFromSound_q4 && above <= -kBelowLimit_q4 ? Liveness::kFailed
                                                                  : Liveness::kUnknown;
}

// With any of the lags, or with none of them.
Liveness PatternWatch::judge_unlearnt(const Sums& sums) {
  bool none = true;
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    const Gain gain = gain_of(sums, lag);
    const std::int32_t above = gain.above_q4(kLeastGain_q10);
    if (gain.above_q4(0) >= kFirstFromNone_q4 && above >= kFirstAboveLimit_q4) {
      return Liveness::kProved;
    }
    none = none && above <= -kFirstBelowLimit_q4;
  }
  return none ? Liveness::kFailed : Liveness::kUnknown;
}

void PatternWatch::learn(const Sums& sums) {
  std::int32_t best = -1;
  Gain gain;
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    const Gain other = gain_of(sums, lag);
    if (other.known && other.q10 > 0 && (best < 0 || other.likeness_q10 > gain.likeness_q10)) {
      best = static_cast<std::int32_t>(lag);
      gain = other;
    }
  }
  if (best < 0 || gain.above_q4(0) < kFirstFromNone_q4) {
    return;
  }
  const std::int32_t seen = std::min(gain.q10, 1024);
  learnt_gain_q10_ = best == learnt_lag_ ? (3 * learnt_gain_q10_ + seen + 2) / 4 : seen;
  learnt_lag_ = best;
  learnt_at_permille_ = level_permille_;
}

void PatternWatch::hold(Liveness told) {
  if (told != Liveness::kUnknown) {
    liveness_ = told;
    undecided_ = 0;
    return;
  }
  undecided_ = std::min(undecided_ + 1, kMostUndecided);
  if (liveness_ == Liveness::kProved && undecided_ == kMostUndecided) {
    liveness_ = Liveness::kUnknown;
  }
}

}  // namespace tubesight::core::lighting
