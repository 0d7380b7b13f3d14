#pragma once

#include <string>

#include "drivers/simulated/scenario.h"

namespace tubesight::board {

/// A scenario as a file that `tubesight simulate` takes; numbers in their shortest exact form.
///
/// What is true of camera, tool and sheet is written as errors of the calibration, and comes back
/// right to the last bit but one. Serves what a campaign draws: no events, no displaced tube-ends,
/// no kJump segments.
[[nodiscard]] std::string scenario_text(const drivers::Scenario& scenario,
                                        const std::string& title);

}  // namespace tubesight::board
