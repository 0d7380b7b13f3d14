#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/base/field.h"
#include "core/base/sighting.h"
#include "core/lighting/brightness_trail.h"
#include "core/lighting/pattern_gain.h"

namespace tubesight::core::lighting {

/// Whether the brightness of the picture follows the levels of the lamp that were in force.
///
/// Both are looked at as second differences over some 67 ms, or 100 ms with a slow lamp, u of the
/// brightness and v of the level led through a lag: that leaves of the light of a tool that moves
/// smoothly next to nothing, and of the pattern most. The gain g = sum(uv) / sum(vv) is 1 where all
/// light is the lamp's and 0 in a picture that knows nothing of it. It is looked at over the last
/// 1.75 s, which do at rest, over 3.5 s and over 9 s, four times a second.
///
/// What u and g v differ by says how well g is known, with two limits. Another lamp with a pattern
/// of its own leaves over what looks like noise and is not: its neighbouring fields say the same.
/// And a sound lamp never leaves over more than the tube-ends' own noise, which their scatter
/// shows: so another lamp's picture is not given the benefit of its own swing.
///
/// Levels count as they were in force, not as they were wanted: no pattern need be known, and what
/// a recording holds is enough to come to the same answer.
class PatternWatch {
 public:
  void begin();

  /// Takes a field: the change of its light since the last one of its parity (BrightnessTrail) and
  /// the level in force. Instants grow.
  void follow(const Field& field, std::optional<LightChange> change);

  /// kProved and kFailed are held until something else is certain; kProved for 5 s at most, and
  /// only until the last seconds speak against it.
  [[nodiscard]] Liveness liveness() const { return liveness_; }

  /// Whether a sound lamp that was seen before would have been proved again by now: for a second
  /// something has spoken against it, and nothing for it.
  [[nodiscard]] bool doubts() const {
    return liveness_ == Liveness::kUnknown && doubted_ >= kDoubtsFrom;
  }

  /// Whether the level should stay, so that it shows soon what is the matter: something speaks
  /// against a sound lamp, since 5 s at most.
  [[nodiscard]] bool wants_level() const { return doubted_ > 0 && doubted_ < kMostUndecided; }

  /// How much of a change of the level is seen in the picture at this level, 1/1024: the lamp's
  /// share in the light. Empty: it was never proved.
  [[nodiscard]] std::optional<std::int32_t> share_q10() const {
    return learnt_lag_ < 0 ? std::nullopt : std::optional(std::min(expected_q10(), 1024));
  }

  /// Whether a small swing is not known to be enough: the picture is not proved now or the lamp not
  /// learnt well yet, or it was seen to follow with so long a lag that little of a swing is left.
  [[nodiscard]] bool needs_wide_swing() const {
    return liveness_ != Liveness::kProved || noise_ratio_q10_ == 0 ||
           span_of(static_cast<std::size_t>(learnt_lag_)) > 0;
  }

  /// How far the gain was below that of a sound lamp when it was looked at last, in its standard
  /// deviations, 1/16, less those that few fields are allowed beside; 0: it was not. For the study
  /// of false alarms, one of which needs -96.
  [[nodiscard]] std::int32_t last_score_q4() const { return score_q4_; }
  [[nodiscard]] std::uint32_t looks() const { return next_block_; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream);

 private:
  static constexpr std::int32_t kMostChains = 1 << 30;
  static constexpr std::int32_t kMostLight = 1 << 28;
  static constexpr std::int32_t kMostGain_q10 =
      2048;  ///< learnt, of a lag that is longer than true

  /// A field of the last 0.3 s.
  struct Moment {
    FieldTime at{0};
    std::int32_t chain = 0;  ///< brightnesses of one chain can be compared
    std::int32_t light_q16 = 0;
    std::array<std::int32_t, kLags> level_q16{};

    template <typename Self, typename Stream>
    static void transfer(Self& self, Stream& stream) {
      auto& [instant, which, light, levels] = self;
      stream(instant);
      stream.number(which, 0, kMostChains);
      stream.number(light, -kMostLight, kMostLight);
      for (auto& level : levels) {
        stream.number(level, 0, kFullLamp_permille << 16);
      }
    }
  };

  static constexpr std::int32_t kMostFields = 1 << 20;
  static constexpr std::int32_t kMostRatio_q10 = 1 << 24;
  static constexpr std::size_t kMoments = 40;      ///< 0.3 s of 120 fields a second
  static constexpr std::int32_t kShortBlocks = 7;  ///< of a quarter of a second
  static constexpr std::int32_t kMiddleBlocks = 14;
  static constexpr std::int32_t kBlocks = 36;
  static constexpr std::int32_t kDoubtsFrom = 4;
  static constexpr std::int32_t kMostUndecided = 20;  ///< blocks: 5 s

  bool is_cut(const LightChange& change);
  void sample(const Moment& now, std::size_t span, std::int64_t scatter_q32);
  [[nodiscard]] const Moment* before(const Moment& moment, FieldTime span,
                                     std::uint32_t& place) const;
  void keep_to_level();
  void close_block();
  [[nodiscard]] PatternSums sum_of(std::int32_t blocks) const;
  [[nodiscard]] PatternGain gain_of(const PatternSums& sums, std::size_t lag) const {
    return core::lighting::gain_of(sums, lag, noise_ratio_q10_);
  }
  [[nodiscard]] std::int32_t expected_q10() const;
  [[nodiscard]] std::int32_t from_sound_q4(const PatternGain& gain) const;
  [[nodiscard]] std::int32_t against_sound_q4(const PatternSums& sums) const;
  [[nodiscard]] Liveness judge(const PatternSums& sums);
  [[nodiscard]] Liveness judge_unlearnt(const PatternSums& sums);
  void learn(const PatternSums& sums);
  [[nodiscard]] std::int32_t likeliest_lag(const PatternSums& sums) const;
  void learn_noise(const PatternGain& gain, const PatternSums& sums);
  [[nodiscard]] bool in_question() const;
  void hold(Liveness told, bool doubted);

  std::array<std::int32_t, kLags> level_q16_{};  ///< led through each lag
  bool led_ = false;
  FieldTime last_{0};
  std::array<std::int32_t, 2> light_q16_{};  ///< of the odd lines and of others: sums of changes
  std::array<std::int32_t, 2> chain_{};
  std::int32_t chains_ = 0;

  std::array<Moment, kMoments> moments_{};
  std::uint32_t next_moment_ = kMoments;
  PatternSums now_{};  ///< of the block that is not full yet
  FieldTime block_until_{0};
  std::array<PatternSums, kBlocks> blocks_{};
  std::uint32_t next_block_ = kBlocks;
  std::int32_t blocks_permille_ = 0;  ///< the level that they are about of

  std::int32_t level_permille_ = 0;      ///< in force in the last field
  std::int32_t learnt_lag_ = -1;         ///< place in kLags_us; -1: nothing was proved yet
  std::int32_t learnt_gain_q10_ = 0;     ///< of the lamp's light in the picture
  std::int32_t learnt_at_permille_ = 0;  ///< with that level
  std::int32_t learnt_fields_ = 0;       ///< from so many
  /// What is left over, to the scatter among tube-ends; 0: the gain is not learnt well yet.
  std::int32_t noise_ratio_q10_ = 0;
  Liveness liveness_ = Liveness::kUnknown;
  std::int32_t undecided_ = 0;  ///< blocks since something was certain
  std::int32_t doubted_ = 0;    ///< of those, blocks since something spoke against a sound lamp
  std::int32_t score_q4_ = 0;
  std::int64_t usual_scatter_q32_ = 0;  ///< of the last fields
};

template <typename Self, typename Stream>
void PatternWatch::transfer(Self& self, Stream& stream) {
  auto& [levels, led, last, lights, chain, chains, moments, next_moment, now, block_until, blocks,
         next_block, blocks_level, level, lag, gain, gain_at, fields, noise, told, undecided,
         doubted, score, usual_scatter] = self;
  for (auto& one : levels) {
    stream.number(one, 0, kFullLamp_permille << 16);
  }
  stream(led, last);
  for (auto& one : lights) {
    stream.number(one, -kMostLight, kMostLight);
  }
  for (auto& one : chain) {
    stream.number(one, 0, kMostChains);
  }
  stream.number(chains, 0, kMostChains);
  stream(moments, next_moment, now, block_until, blocks, next_block);
  stream.number(blocks_level, 0, kFullLamp_permille);
  stream.number(level, 0, kFullLamp_permille);
  stream.number(lag, -1, static_cast<std::int32_t>(kLags) - 1);
  stream.number(gain, 0, kMostGain_q10);
  stream.number(gain_at, 0, kFullLamp_permille);
  stream.number(fields, 0, kMostFields);
  stream.number(noise, 0, kMostRatio_q10);
  stream.choice(told, Liveness::kFailed);
  stream.number(undecided, 0, 1 << 20);
  stream.number(doubted, 0, 1 << 20);
  stream(score);
  stream.number(usual_scatter, 0, PatternSums::kMostSum);
}

}  // namespace tubesight::core::lighting
