#pragma once

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// Runs `tubesight devices`: lists what this machine has, as a box's settings name it. Opens
/// cameras and GPIO chips to ask what they offer, and changes nothing.
[[nodiscard]] ExitStatus run_devices();

}  // namespace tubesight::board
