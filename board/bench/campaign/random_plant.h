#pragma once

#include <array>

#include "board/bench/campaign/random_source.h"
#include "board/bench/campaign/stratum.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::board::campaign {

/// Addresses of a random sheet run from 0 to this in rows and columns: the tool starts well inside,
/// and the sheet's edges come into view now and then.
inline constexpr std::int32_t kLastAddress = 40;

/// Draws the plant of a move: pitch 20.6 to 32.6 mm, bores of 60 to 74 % of it, numbering of any
/// kind and hand, stays and lanes without tubes, plugs listed and not, deposits, the plate's looks.
///
/// Writes the scene's sheet and look, and what the box is told of it.
void draw_plant(const Stratum& stratum, RandomSource& random, drivers::Scenario& scenario);

/// Distance of neighbouring tubes, mm.
[[nodiscard]] double pitch_mm(const core::TubesheetSettings& sheet);

}  // namespace tubesight::board::campaign
