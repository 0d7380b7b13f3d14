#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace tubesight::board {

/// How long something took, over all times: counts in steps of an eighth of the value, and the
/// worst exactly. Plain bytes, which a core::Snapshot carries; nothing is allocated.
class LatencyHistogram {
 public:
  void add(std::chrono::nanoseconds took) {
    const auto took_us =
        static_cast<std::uint32_t>(std::clamp<std::int64_t>(took.count() / 1000, 0, kLongest_us));
    ++counts_[bin_of(took_us)];
    ++count_;
    worst_us_ = std::max(worst_us_, took_us);
  }

  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] std::int64_t worst_us() const { return worst_us_; }

  /// What this share of all, 0..1, took at most; the upper end of its bin. 0 before the first.
  [[nodiscard]] std::int64_t quantile_us(double share) const {
    const auto wanted = static_cast<std::int64_t>(share * static_cast<double>(count_));
    std::int64_t below = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      below += counts_[bin];
      if (below > wanted || (below == count_ && count_ > 0)) {
        return std::min<std::int64_t>(end_of(bin), worst_us_);
      }
    }
    return 0;
  }

 private:
  // Below 8 us a bin a microsecond; from there eight bins an octave.
  static constexpr std::uint32_t kLongest_us = (1U << 30U) - 1;
  static constexpr std::size_t kBins = 8 * 28;  ///< the last for 30 bits

  static constexpr std::size_t bin_of(std::uint32_t us) {
    if (us < 8) {
      return us;
    }
    const auto octave = static_cast<std::uint32_t>(std::bit_width(us)) - 4;
    return 8 * (octave + 1) + ((us >> octave) & 7U);
  }
  static constexpr std::int64_t end_of(std::size_t bin) {
    if (bin < 16) {
      return static_cast<std::int64_t>(bin);
    }
    const std::size_t octave = bin / 8 - 1;
    return (static_cast<std::int64_t>(8 + bin % 8 + 1) << octave) - 1;
  }

  std::array<std::uint32_t, kBins> counts_{};
  std::int64_t count_ = 0;
  std::uint32_t worst_us_ = 0;
};

}  // namespace tubesight::board
