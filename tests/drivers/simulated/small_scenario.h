#pragma once

#include <memory>

#include "drivers/simulated/scenario.h"
#include "tests/support/synthetic_sheet.h"

namespace tubesight::drivers {

/// A small camera (317 by 240, 30 frames a second, even lines first) below a square sheet: half a
/// second at rest under tube (40, 60), then to the next column at 100 mm/s, then rest.
inline std::unique_ptr<Scenario> small_scenario() {
  auto scenario = std::make_unique<Scenario>();
  tests::make_synthetic_settings(scenario->told, 2);
  scenario->scene.camera = scenario->told.camera;
  scenario->scene.tool = scenario->told.tool;
  scenario->scene.sheet = scenario->told.tubesheet;
  scenario->from = {1524.4, 1015.7, 60.0, 2.0, 0.0, 0.0};
  core::kinematics::PathSegment rest;
  rest.rest_s = 0.5;
  core::kinematics::PathSegment move;
  move.kind = core::kinematics::SegmentKind::kMove;
  move.to_mm = {1549.4, 1015.7};
  move.limits = {100.0, 1000.0, 1e4};
  scenario->path = {rest, move, rest};
  scenario->video.exposure_s = 0.0;
  scenario->seed = 5;
  return scenario;
}

}  // namespace tubesight::drivers
