#include <algorithm>
#include <cmath>
#include <memory>

#include "board/bench/campaign/random_parts.h"
#include "board/bench/campaign/random_stream.h"
#include "core/kinematics/tool_path.h"
#include "core/tubesheet/sheet_places.h"

namespace tubesight::board::campaign {
namespace {

using core::TubeAddress;
using core::tubesheet::AddressFault;
using core::tubesheet::check_address;
using drivers::Scenario;

// One to three steps, along a row, a column or both, of those that the addresses have.
TubeAddress draw_steps(RandomSource& random, const core::TubesheetSettings& sheet) {
  for (;;) {
    const TubeAddress steps{random.whole(-3, 3), random.whole(-3, 3)};
    if (steps != TubeAddress{} && core::tubesheet::check_move(sheet, {steps.row, steps.column}) ==
                                      core::tubesheet::MoveFault::kNone) {
      return steps;
    }
  }
}

// False, and the clicks as before, where a click would be at no tube.
bool move_addresses(const core::TubesheetSettings& told, TubeAddress steps, Clicks& clicks) {
  Clicks moved;
  for (core::StartPoint point : clicks) {
    point.address = {point.address.row + steps.row, point.address.column + steps.column};
    if (check_address(told, point.address) != AddressFault::kNone) {
      return false;
    }
    static_cast<void>(moved.try_push_back(point));
  }
  clicks = moved;
  return true;
}

// Tube-ends in view that would stand where the box is told that none is open.
int count_contradictions(const std::vector<Visible>& visible, const core::TubesheetSettings& told,
                         TubeAddress steps) {
  const auto plugged = told.plugged.view();
  return static_cast<int>(std::count_if(visible.begin(), visible.end(), [&](const Visible& tube) {
    const TubeAddress named{tube.address.row + steps.row, tube.address.column + steps.column};
    return check_address(told, named) != AddressFault::kNone ||
           std::find(plugged.begin(), plugged.end(), named) != plugged.end();
  }));
}

// Only where the lists are enough to know it by: on a bare sheet the start is the operator's word.
bool draw_wrong_start(RandomSource& random, const core::rendering::Truth& truth,
                      Scenario& scenario) {
  constexpr int kKnown = 6;
  constexpr int kTries = 6;
  const auto visible = list_visible(truth, core::kinematics::transform_of(scenario.from), scenario);
  for (int i = 0; i < kTries; ++i) {
    const TubeAddress steps = draw_steps(random, scenario.scene.sheet);
    if (count_contradictions(visible, scenario.told.tubesheet, steps) >= kKnown &&
        move_addresses(scenario.told.tubesheet, steps, scenario.told.start.tubes)) {
      return true;
    }
  }
  return false;
}

bool draw_restart(RandomSource& random, const core::rendering::Truth& truth, Scenario& scenario) {
  const double period_s = field_s(scenario);
  const auto last = static_cast<std::int32_t>(0.85 * scenario.video.length_s / period_s);
  drivers::ScenarioEvent told;
  told.at_s = period_s * random.whole(7, std::max(7, last));
  const auto path = std::make_unique<core::kinematics::ToolPath>();
  if (!path->begin(scenario.from)) {
    return false;
  }
  for (const auto& segment : scenario.path) {
    if (!path->add(segment)) {
      return false;
    }
  }
  core::Start start;
  if (!draw_clicks(random, truth, path->state_at(told.at_s).T_sheet_tool, scenario, start.tubes) ||
      !move_addresses(scenario.told.tubesheet, draw_steps(random, scenario.scene.sheet),
                      start.tubes)) {
    return false;
  }
  told.event.origin = core::EventOrigin::kOperator;
  told.event.content = start;
  scenario.events.push_back(told);
  return true;
}

}  // namespace

void draw_wrong_starts(const Stratum& stratum, std::uint64_t seed, std::int64_t move,
                       const core::rendering::Truth& truth, Scenario& scenario) {
  if (stratum.fault != FaultGroup::kJump) {
    return;
  }
  RandomSource wrong = random_stream(seed, move, "wrong start");
  RandomSource again = random_stream(seed, move, "wrong restart");
  const bool drawn = (wrong.chance(0.5) && draw_wrong_start(wrong, truth, scenario)) ||
                     (again.chance(0.2) && draw_restart(again, truth, scenario));
  if (drawn) {
    scenario.faults.clear();
  }
}

}  // namespace tubesight::board::campaign
