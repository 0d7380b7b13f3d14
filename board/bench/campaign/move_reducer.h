#pragma once

#include <cstdint>
#include <functional>

#include "drivers/simulated/scenario.h"

namespace tubesight::board::campaign {

/// Whether a scenario still shows what it is kept for.
using ShowsIt = std::function<bool(const drivers::Scenario&)>;

/// Leaves out of a scenario what it does not need to show something: the end of the recording, path
/// parts, faults, plugs, what the look, the sensor and the calibrations add; shortens faults and
/// rests by halves. Gives up a change when the scenario no longer shows it.
///
/// `scenario` must show it; it still does afterwards. Runs some dozens of scenarios.
void reduce(drivers::Scenario& scenario, const ShowsIt& shows_it);

}  // namespace tubesight::board::campaign
