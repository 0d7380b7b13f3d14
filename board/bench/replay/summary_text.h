#pragma once

#include <cstdint>
#include <string>

#include "board/bench/replay/replay_statistics.h"

namespace tubesight::board {

/// What the summary says of the recording itself.
struct RecordingFacts {
  std::string name;  ///< as the user gave it
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  bool interlaced = false;
  bool cut_short = false;
};

/// Writes what a person wants to know of a replay: time in each state and why, losses, starts,
/// claims, speed, plugs, and last the tubes visited. Lines end in a line feed.
[[nodiscard]] std::string summary_text(const RecordingFacts& recording,
                                       const ReplayStatistics& statistics);

/// Says in one line why a recording was not tracked from a start to its end, for `--must-track`:
/// no start was taken, or it was lost. Empty when it was.
[[nodiscard]] std::string why_not_tracked(const std::string& recording,
                                          const ReplayStatistics& statistics);

}  // namespace tubesight::board
