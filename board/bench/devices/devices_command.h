#pragma once

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight devices`.
struct DevicesOptions {
  bool network = false;  ///< cameras of GigE Vision and USB3 Vision, by a broadcast
};

/// Runs `tubesight devices`: lists what this machine has, as a box's settings name it. Opens
/// cameras and GPIO chips to ask what they offer, and changes nothing. Nothing is sent to a network
/// unless it is asked for.
[[nodiscard]] ExitStatus run_devices(const DevicesOptions& options);

}  // namespace tubesight::board
