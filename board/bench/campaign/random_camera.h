#pragma once

#include "board/bench/campaign/random_source.h"
#include "board/bench/campaign/stratum.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::board::campaign {

/// Draws the camera, how it sits on the tool, its calibrations (a little off, as calibrations are),
/// the search window, the lamp and the sensor. Needs the plant: a coarser pitch is looked at from
/// farther away.
void draw_camera(const Stratum& stratum, RandomSource& random, drivers::Scenario& scenario);

/// Draws ordinary light and an ordinary sensor.
void draw_light(RandomSource& random, drivers::Scenario& scenario);

}  // namespace tubesight::board::campaign
