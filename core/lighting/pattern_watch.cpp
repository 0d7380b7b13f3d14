#include "core/lighting/pattern_watch.h"

#include <algorithm>
#include <cstdlib>

namespace tubesight::core::lighting {
namespace {

/// From field to field of a second difference: 67 and 100 ms of the usual 60 fields a second.
constexpr std::array<FieldTime, kSpans> kSpan = {std::chrono::milliseconds(60),
                                                 std::chrono::milliseconds(93)};
/// Both halves are of one length.
constexpr FieldTime kUneven = std::chrono::milliseconds(8);
/// What changes faster than this is on its way to another place.
constexpr std::int32_t kMostChange_q16 = 3277;  // 5 %
/// The same of a second difference: the wide swing of a lamp without lag.
constexpr std::int32_t kMostBend_q16 = 5898;  // 9 %
constexpr std::int64_t kMostScatter_q32 = std::int64_t{kMostChange_q16} * kMostChange_q16;
/// A cut: changes that differ by 0.7 % and four times as much as usual.
constexpr std::int64_t kLeastCut_q32 = 459 * 459;
constexpr std::int64_t kCut = 16;
constexpr FieldTime kBlock = std::chrono::milliseconds(250);
/// Longer without a field, and nothing is led through a lag any more.
constexpr FieldTime kPause = std::chrono::milliseconds(500);

/// The likelihoods of two lags differ by e^4 where the one leaves over so much less, over the
/// number of fields.
constexpr std::int64_t kClearlyLess = 16;
constexpr std::int64_t kFieldsToLearn = 100;
/// From here on there is no other light worth the name.
constexpr std::int32_t kAllTheLamps_q10 = 922;  // 90 %
/// While nothing was proved: what other light may leave to the lamp.
constexpr std::int32_t kLeastGain_q10 = 123;  // 12 %
// Deviations that are certain, in 1/16. Each answer is as far from what the other would show as
// false alarms are to be rare, and on its own side of the limit between them.
constexpr std::int32_t kFirstFromNone_q4 = 5 * 16;  // the lag is chosen among several
constexpr std::int32_t kFromNone_q4 = 9 * 16 / 2;   // proved: a picture that knows nothing, g = 0
constexpr std::int32_t kFromSound_q4 = 6 * 16;      // failed: a sound lamp, g as learnt
constexpr std::int32_t kUnlikely_q4 = 2 * 16;       // longer times prove nothing: the same
constexpr std::int32_t kDoubt_q4 = 3 * 16;          // not proved any more: the same
constexpr std::int32_t kAboveLimit_q4 = 16;
constexpr std::int32_t kFirstAboveLimit_q4 = 2 * 16;
constexpr std::int32_t kFirstBelowLimit_q4 = 6 * 16;
/// What noise leaves over at most, to the scatter, until that is learnt.
constexpr std::int32_t kUnlearntRatio_q10 = 6 * 1024;

}  // namespace

void PatternWatch::begin() {
  led_ = false;
  chain_ = {};
  chains_ = 0;
  next_moment_ = kMoments;  // so that counting back from there never passes 0
  moments_.fill({});
  now_ = {};
  block_until_ = FieldTime(0);
  blocks_.fill({});
  next_block_ = kBlocks;
  blocks_permille_ = 0;
  learnt_lag_ = -1;
  learnt_fields_ = 0;
  noise_ratio_q10_ = 0;
  liveness_ = Liveness::kUnknown;
  undecided_ = 0;
  doubted_ = 0;
  score_q4_ = 0;
  usual_scatter_q32_ = kMostScatter_q32;
}

void PatternWatch::follow(const Field& field, std::optional<LightChange> change) {
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
  const bool goes_on = change && chain_[lines] != 0 && !is_cut(*change) &&
                       std::abs(light_q16_[lines]) < kMostLight / 2;
  if (!goes_on) {
    chains_ = chains_ < kMostChains ? chains_ + 1 : 1;
    chain_[lines] = chains_;
    light_q16_[lines] = 0;
  } else {
    light_q16_[lines] += std::clamp(change->mean_q16, -kMostLight / 2, kMostLight / 2);
  }
  const Moment moment{field.mid_exposure, chain_[lines], light_q16_[lines], level_q16_};
  if (goes_on) {
    for (std::size_t span = 0; span < kSpans; ++span) {
      sample(moment, span, std::min(change->scatter_q32, kMostScatter_q32));
    }
  }
  moments_[next_moment_ % kMoments] = moment;
  ++next_moment_;
  if (field.mid_exposure >= block_until_ || field.mid_exposure + kBlock < block_until_) {
    block_until_ = field.mid_exposure + kBlock;
    close_block();
  }
}

// Tube-ends whose light differs by much more than it did, each from the others: what is seen is
// another picture now, and its difference to the one before tells nothing of a lamp.
bool PatternWatch::is_cut(const LightChange& change) {
  const std::int64_t scatter = std::min(change.scatter_q32, kMostScatter_q32);
  const bool cut = scatter > kLeastCut_q32 && scatter / kCut > usual_scatter_q32_;
  usual_scatter_q32_ += (scatter - usual_scatter_q32_) / 32;
  return cut;
}

/// The last moment of the same chain that is `span` older, looked for from `place` on backwards.
const PatternWatch::Moment* PatternWatch::before(const Moment& moment, FieldTime span,
                                                 std::uint32_t& place) const {
  for (std::uint32_t back = 1; back <= kMoments; ++back) {
    const Moment& then = moments_[(place - back) % kMoments];
    if (then.chain == moment.chain && moment.at - then.at >= span) {
      place -= back;
      return &then;
    }
  }
  return nullptr;
}

void PatternWatch::sample(const Moment& now, std::size_t span, std::int64_t scatter_q32) {
  // On the way to another level a lag that is none of those tried would count more than the swing.
  const std::int64_t way = std::int64_t{now.level_q16.back()} - now.level_q16.front();
  if (std::abs(way) * 12 > now.level_q16.front()) {
    return;
  }
  std::uint32_t place = next_moment_;
  const Moment* const middle = before(now, kSpan[span], place);
  const Moment* const first = middle != nullptr ? before(*middle, kSpan[span], place) : nullptr;
  if (first == nullptr) {
    return;
  }
  const FieldTime uneven = (now.at - middle->at) - (middle->at - first->at);
  if (uneven > kUneven || uneven < -kUneven) {
    return;
  }
  const std::int64_t u = std::clamp(now.light_q16 - 2 * middle->light_q16 + first->light_q16,
                                    -kMostBend_q16, kMostBend_q16);
  std::array<std::int64_t, kLags> v{};
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    const std::int64_t level = middle->level_q16[lag];
    const std::int64_t bend = now.level_q16[lag] - 2 * level + first->level_q16[lag];
    v[lag] = level > 0 ? bend * 65'536 / level : kMostBend_q16 + 1;
    if (v[lag] > kMostBend_q16 || v[lag] < -kMostBend_q16) {
      return;
    }
  }
  PatternSums::OfSpan& sums = now_.spans[span];
  ++sums.count;
  sums.uu += u * u;
  sums.scatter += scatter_q32;
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    if (span_of(lag) == span) {
      now_.uv[lag] += u * v[lag];
      now_.vv[lag] += v[lag] * v[lag];
    }
  }
}

PatternSums PatternWatch::sum_of(std::int32_t blocks) const {
  PatternSums sums;
  for (std::uint32_t back = 1; back <= static_cast<std::uint32_t>(blocks); ++back) {
    sums.add(blocks_[(next_block_ - back) % kBlocks]);
  }
  return sums;
}

// Where other light is learnt, fields of another level have another gain, and are forgotten; but
// for the last ones, in which the level cannot have changed that much. A level that is led through
// a picture that does not follow would never be found out else.
void PatternWatch::keep_to_level() {
  const std::int32_t off = std::abs(level_permille_ - blocks_permille_);
  if (off * 8 <= blocks_permille_) {
    return;
  }
  const bool led_there = off * 4 <= blocks_permille_;  // not by a jump
  blocks_permille_ = level_permille_;
  if (learnt_lag_ >= 0 && learnt_gain_q10_ < kAllTheLamps_q10) {
    now_ = led_there ? now_ : PatternSums{};
    for (std::uint32_t back = led_there ? kShortBlocks : 1; back <= kBlocks; ++back) {
      blocks_[(next_block_ - back) % kBlocks] = {};
    }
  }
}

void PatternWatch::close_block() {
  keep_to_level();
  blocks_[next_block_ % kBlocks] = now_;
  ++next_block_;
  now_ = {};
  score_q4_ = 0;
  // The shortest time that is enough to be certain. What a longer one proves is no longer so where
  // a shorter one speaks against it.
  Liveness told = Liveness::kUnknown;
  bool doubted = false;
  bool unlikely = false;
  for (const std::int32_t blocks : {kShortBlocks, kMiddleBlocks, kBlocks}) {
    const PatternSums sums = sum_of(blocks);
    told = judge(sums);
    if (told == Liveness::kProved && unlikely) {
      told = Liveness::kUnknown;
    }
    if (told != Liveness::kUnknown) {
      break;
    }
    const std::int32_t against_q4 = against_sound_q4(sums);
    unlikely = unlikely || against_q4 >= kUnlikely_q4;
    doubted = doubted || against_q4 >= kDoubt_q4;
  }
  hold(told, doubted);
  if (liveness_ == Liveness::kProved && undecided_ == 0 && !in_question()) {
    learn(sum_of(kBlocks));
  }
}

// Light that is not the lamp's stays when the lamp is dimmed: g = k L / (a + k L), and a / k was
// learnt with another level L. More than 1 comes of a lag that is longer than the lamp's, and is as
// it is.
std::int32_t PatternWatch::expected_q10() const {
  const std::int64_t lamp = std::int64_t{learnt_gain_q10_} * level_permille_;
  const std::int64_t other = std::int64_t{1024 - learnt_gain_q10_} * learnt_at_permille_;
  if (other < 0) {
    return learnt_gain_q10_;
  }
  return static_cast<std::int32_t>(lamp + other > 0 ? lamp * 1024 / (lamp + other) : 0);
}

// What a sound lamp's gain is was learnt from some fields, and is no better known than those say:
// beside the deviation of the fields that are judged stands that of the ones that were learnt from.
std::int32_t PatternWatch::from_sound_q4(const PatternGain& gain) const {
  const std::int64_t learnt = std::max(learnt_fields_, 1);
  const std::int64_t deviation_q20 =
      gain.from_sound_q10 * integer_root(((learnt + gain.count) << 20) / learnt);
  return static_cast<std::int32_t>(
      std::int64_t{gain.q10 - expected_q10()} * (16 * 1024) / deviation_q20 + gain.sound_tail_q4);
}

// Of a sound lamp these fields would have shown more, though it is not certain yet that there is
// none. That a picture was proved by older fields is worth nothing then.
std::int32_t PatternWatch::against_sound_q4(const PatternSums& sums) const {
  if (learnt_lag_ < 0) {
    return 0;
  }
  const PatternGain gain =
      core::lighting::gain_of(sums, static_cast<std::size_t>(learnt_lag_),
                              noise_ratio_q10_ > 0 ? noise_ratio_q10_ : kUnlearntRatio_q10);
  return gain.known && gain.q10 < expected_q10() * 5 / 8 ? -from_sound_q4(gain) : 0;
}

Liveness PatternWatch::judge(const PatternSums& sums) {
  const PatternGain gain =
      learnt_lag_ < 0 ? PatternGain{} : gain_of(sums, static_cast<std::size_t>(learnt_lag_));
  if (!gain.known) {
    return judge_unlearnt(sums);
  }
  const std::int32_t expected = expected_q10();
  const std::int32_t from_sound = from_sound_q4(gain);
  score_q4_ = noise_ratio_q10_ > 0 ? std::min(score_q4_, from_sound) : 0;
  if (gain.above_q4(0) >= kFromNone_q4 + gain.tail_q4 &&
      gain.above_q4(std::max(expected / 2, kLeastGain_q10)) >= kAboveLimit_q4) {
    return Liveness::kProved;
  }
  if (noise_ratio_q10_ > 0 && from_sound <= -kFromSound_q4 && gain.q10 < expected * 5 / 8) {
    return Liveness::kFailed;
  }
  return judge_unlearnt(sums) == Liveness::kProved ? Liveness::kProved : Liveness::kUnknown;
}

// With any of the lags, or with none of them.
Liveness PatternWatch::judge_unlearnt(const PatternSums& sums) {
  bool none = true;
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    const PatternGain gain = gain_of(sums, lag);
    const std::int32_t above = gain.above_q4(kLeastGain_q10);
    if (gain.above_q4(0) >= kFirstFromNone_q4 + gain.tail_q4 && above >= kFirstAboveLimit_q4) {
      return Liveness::kProved;
    }
    none = none && above <= -kFirstBelowLimit_q4 - gain.tail_q4;
  }
  return none ? Liveness::kFailed : Liveness::kUnknown;
}

// The one that leaves over least; one that was learnt stays until another is clearly likelier.
std::int32_t PatternWatch::likeliest_lag(const PatternSums& sums) const {
  std::int32_t best = learnt_lag_;
  PatternGain gain = best < 0 ? PatternGain{} : gain_of(sums, static_cast<std::size_t>(best));
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    const PatternGain other = gain_of(sums, lag);
    if (!other.known || other.q10 <= 0) {
      continue;
    }
    const std::int64_t clearly = best == learnt_lag_ ? other.count - kClearlyLess : other.count;
    if (!gain.known || (other.rest << 10) / std::max<std::int64_t>(other.all, 1) * other.count <
                           (gain.rest << 10) / std::max<std::int64_t>(gain.all, 1) * clearly) {
      best = static_cast<std::int32_t>(lag);
      gain = other;
    }
  }
  return best;
}

void PatternWatch::learn(const PatternSums& sums) {
  const std::int32_t best = likeliest_lag(sums);
  if (best < 0) {
    return;
  }
  const PatternGain gain = gain_of(sums, static_cast<std::size_t>(best));
  if (gain.above_q4(0) < kFirstFromNone_q4) {
    return;
  }
  // What few fields say, beside a level that is led to its place, is a beginning.
  const bool many = gain.count >= kFieldsToLearn;
  if (noise_ratio_q10_ > 0 && !many) {
    return;
  }
  const bool goes_on = noise_ratio_q10_ > 0 && best == learnt_lag_;
  // More than 1 only where that is certain: what was proved first by chance is too much.
  const std::int32_t seen =
      std::min(std::clamp(gain.q10 - 2 * gain.from_none_q10, 1024, kMostGain_q10), gain.q10);
  learnt_gain_q10_ = goes_on ? (3 * expected_q10() + seen + 2) / 4 : seen;
  const auto fields = static_cast<std::int32_t>(std::min<std::int64_t>(gain.count, kMostFields));
  learnt_fields_ = goes_on ? std::max(learnt_fields_, fields) : fields;
  learnt_lag_ = best;
  learnt_at_permille_ = level_permille_;
  if (many) {
    learn_noise(gain, sums);
  }
}

// Slowly up, so that what another picture leaves over does not pass for noise before it is found
// out, and much more slowly down, as a tool that moves makes more of it than one at rest.
void PatternWatch::learn_noise(const PatternGain& gain, const PatternSums& sums) {
  const std::size_t span = span_of(static_cast<std::size_t>(learnt_lag_));
  const std::int64_t scatter = std::max<std::int64_t>(sums.spans[span].scatter >> 8, 1);
  const std::int64_t noise = std::max<std::int64_t>(
      gain.rest - of_lag(sums.vv[static_cast<std::size_t>(learnt_lag_)] >> 8), 0);
  const auto seen = static_cast<std::int32_t>(
      std::clamp<std::int64_t>((noise << 10) / scatter, 1, kMostRatio_q10));
  noise_ratio_q10_ =
      noise_ratio_q10_ == 0
          ? seen
          : std::clamp(seen, noise_ratio_q10_ - noise_ratio_q10_ / 256,
                       std::min(noise_ratio_q10_ + noise_ratio_q10_ / 64 + 1, kMostRatio_q10));
}

// The last fields show so little of the lamp that they may be another picture's already.
bool PatternWatch::in_question() const {
  if (learnt_lag_ < 0) {
    return false;
  }
  const PatternGain gain = gain_of(sum_of(kShortBlocks), static_cast<std::size_t>(learnt_lag_));
  return gain.known && gain.q10 < expected_q10() * 5 / 8;
}

void PatternWatch::hold(Liveness told, bool doubted) {
  if (told != Liveness::kUnknown) {
    if (told == Liveness::kFailed && liveness_ != told) {
      blocks_.fill({});  // what was seen of a sound lamp proves nothing any more
    }
    liveness_ = told;
    undecided_ = 0;
    doubted_ = 0;
    return;
  }
  doubted_ = doubted || doubted_ > 0 ? std::min(doubted_ + 1, kMostUndecided) : 0;
  undecided_ = std::min(undecided_ + 1, kMostUndecided);
  if (liveness_ == Liveness::kProved && (doubted || undecided_ == kMostUndecided)) {
    liveness_ = Liveness::kUnknown;
  }
}

}  // namespace tubesight::core::lighting
