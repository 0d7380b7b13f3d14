#pragma once

#include "board/bench/output/exit_status.h"
#include "board/bench/simulate/simulate_options.h"

namespace tubesight::board {

/// Runs `tubesight simulate`: plays a scenario and writes the recording with its truth.
///
/// Nothing is written before the scenario has been checked whole; what is wrong goes to standard
/// error, one line each.
[[nodiscard]] ExitStatus run_simulate(const SimulateOptions& options);

}  // namespace tubesight::board
