#pragma once

#include "board/bench/campaign/random_source.h"
#include "board/bench/campaign/stratum.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::board::campaign {

/// Draws the faults of a move, one or now and then two of its group, at any time of the path; the
/// first few fields are spared, so that the start is sound. Needs plant and path.
void draw_faults(const Stratum& stratum, RandomSource& random, drivers::Scenario& scenario);

}  // namespace tubesight::board::campaign
