#pragma once

#include "board/bench/output/exit_status.h"
#include "board/bench/replay/replay_options.h"

namespace tubesight::board {

/// `tubesight replay`: the vision box on a recording.
///
/// The summary goes to standard output, messages to standard error. A recording that is cut short
/// is done as far as it goes, which a message says; a recording without one whole frame, or any
/// other wrong file, leaves no output.
[[nodiscard]] ExitStatus run_replay(const ReplayOptions& options);

}  // namespace tubesight::board
