#pragma once

#include <chrono>
#include <cstdint>

#include "board/visionbox/source_clock.h"

namespace tubesight::board {

/// What the lamp does when the robot says nothing for long.
struct SilentLinkSettings {
  std::chrono::seconds after{0};   ///< 0: the lamp holds its level
  std::int32_t most_permille = 0;  ///< what may shine then, unless the box tracks
};

/// Finds out whether the robot has fallen silent. Asks no clock.
class SilentLink {
 public:
  explicit SilentLink(const SilentLinkSettings& settings) : settings_(settings) {}

  /// What may shine from `now` on, given the requests that came so far. While the box tracks, all
  /// of it: the track would be lost, and nobody had asked for that.
  [[nodiscard]] std::int32_t most_permille(std::int64_t requests, bool tracking,
                                           MonotonicTime now) {
    if (requests != requests_) {
      requests_ = requests;
      heard_ = now;
    }
    const bool silent =
        settings_.after > std::chrono::seconds(0) && now - heard_ >= settings_.after;
    return silent && !tracking ? settings_.most_permille : kAll_permille;
  }

 private:
  static constexpr std::int32_t kAll_permille = 1000;

  SilentLinkSettings settings_;
  std::int64_t requests_ = -1;  ///< at the last look
  MonotonicTime heard_{0};
};

}  // namespace tubesight::board
