#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/field.h"

namespace tubesight::core::lighting {

/// Lags of a lamp that are tried: time constants of the first order. An LED has none, a small
/// incandescent bulb some tenths of a second.
inline constexpr std::array<std::int32_t, 5> kLags_us = {0, 30'000, 70'000, 130'000, 220'000};
inline constexpr std::size_t kLags = kLags_us.size();
/// Differences are taken over so long: a slow lamp needs longer to show more than noise.
inline constexpr std::size_t kSpans = 2;
[[nodiscard]] constexpr std::size_t span_of(std::size_t lag) { return lag < 3 ? 0 : 1; }

/// Sums over some time of numbers in 1/65536.
struct PatternSums {
  struct OfSpan {
    std::int64_t count = 0;
    std::int64_t uu = 0;
    std::int64_t scatter = 0;  ///< squares of the brightness's deviation

    template <typename Self, typename Stream>
    static void transfer(Self& self, Stream& stream) {
      auto& [n, squares, deviations] = self;
      stream.number(n, 0, 1 << 20);
      stream.number(squares, 0, kMostSum);
      stream.number(deviations, 0, kMostSum);
    }
  };
  static constexpr std::int64_t kMostSum = std::int64_t{1} << 40;

  std::array<OfSpan, kSpans> spans{};
  std::array<std::int64_t, kLags> uv{};
  std::array<std::int64_t, kLags> vv{};

  void add(const PatternSums& other);
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [of_spans, products, levels] = self;
    stream(of_spans);
    for (auto& one : products) {
      stream.number(one, -kMostSum, kMostSum);
    }
    for (auto& one : levels) {
      stream.number(one, 0, kMostSum);
    }
  }
};

/// What sums say of the gain with one lag.
struct PatternGain {
  bool known = false;
  std::int32_t q10 = 0;             ///< 1024: all light is the lamp's
  std::int32_t from_none_q10 = 0;   ///< its deviation in a picture that knows nothing of the lamp
  std::int32_t from_sound_q10 = 0;  ///< and in that of a sound one
  std::int32_t tail_q4 = 0;         ///< further deviations that few fields need to be certain
  std::int32_t sound_tail_q4 = 0;   ///< the same against a sound lamp
  std::int64_t count = 0;           ///< fields
  std::int64_t rest = 0;            ///< what it does not explain: sum of squares, 1/2^24
  std::int64_t all = 0;             ///< and explains: sum(uu)

  /// So many deviations above `limit_q10`, in 1/16.
  [[nodiscard]] std::int32_t above_q4(std::int32_t limit_q10) const;
};

/// What the sums say with one of the lags. `noise_ratio_q10`: what was learnt that a sound lamp
/// leaves over, to the scatter among tube-ends; 0: nothing yet.
[[nodiscard]] PatternGain gain_of(const PatternSums& sums, std::size_t lag,
                                  std::int32_t noise_ratio_q10);

/// What a lag that is none of those tried leaves over at most, of the pattern's sum of squares.
[[nodiscard]] constexpr std::int64_t of_lag(std::int64_t vv) { return vv / 16; }

/// The root, rounded down.
[[nodiscard]] std::int64_t integer_root(std::int64_t value);

}  // namespace tubesight::core::lighting
