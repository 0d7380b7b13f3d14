#pragma once

#include "board/bench/campaign/random_source.h"
#include "board/bench/campaign/stratum.h"
#include "core/rendering/tube_ends.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::board::campaign {

/// Draws the limits of [motion] and a path within them: rest, moves by a few tubes at the band's
/// speed, changes of height, heading and lean, docking, rest; 70 to 80 fields, give or take.
///
/// The tool ends a move up to a millimetre beside the tube, as a robot does. `ends` is the scene's.
void draw_path(const Stratum& stratum, RandomSource& random, const core::rendering::TubeEnds& ends,
               drivers::Scenario& scenario);

}  // namespace tubesight::board::campaign
