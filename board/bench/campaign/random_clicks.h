#pragma once

#include "board/bench/campaign/random_source.h"
#include "core/rendering/truth.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::board::campaign {

/// Draws an operator's three clicks into the first field: open tube-ends wholly in view near the
/// optimum point, not in one line, each up to 60 % of the tube-end's radius off its middle.
///
/// False when the view does not show three such tube-ends.
[[nodiscard]] bool draw_clicks(RandomSource& random, const core::rendering::Truth& truth,
                               drivers::Scenario& scenario);

}  // namespace tubesight::board::campaign
