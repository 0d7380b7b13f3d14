#include "board/visionbox/life_signs.h"

#include <string_view>

namespace tubesight::board {
namespace {

constexpr std::array<std::string_view, kParts> kNames = {"the tracking", "the robot's link",
                                                         "the lamp", "the control desk"};

}  // namespace

void LifeSigns::look(const Beats& beats, MonotonicTime now) {
  stuck_.clear();
  for (std::size_t i = 0; i < kParts; ++i) {
    Seen& seen = seen_[i];
    if (beats[i] != seen.beats) {
      seen = {beats[i], now};
    }
    if (seen.beats >= 0 && now - seen.since > kStuckAfter) {
      stuck_ += stuck_.empty() ? "" : ", ";
      stuck_ += kNames[i];
    }
  }
}

}  // namespace tubesight::board
