#pragma once

#include <string>

#include "board/bench/replay_options.h"

namespace tubesight::board {

/// Says in one line why the outputs of a replay cannot go where they are told to: two to one place,
/// onto a file that is read, or a compressed video. Empty when they can.
///
/// Pipes, terminals and devices may be named as often as one likes.
[[nodiscard]] std::string find_output_conflict(const ReplayOptions& options);

}  // namespace tubesight::board
