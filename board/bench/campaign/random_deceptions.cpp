#include <algorithm>
#include <vector>

#include "board/bench/campaign/random_parts.h"
#include "board/bench/campaign/random_stream.h"
#include "core/tubesheet/sheet_places.h"

namespace tubesight::board::campaign {
namespace {

using core::TubeAddress;
using core::kinematics::SegmentKind;
using core::rendering::TubeEndKind;
using drivers::Fault;
using drivers::FaultKind;
using drivers::Scenario;

double some_time(RandomSource& random, const Scenario& scenario) {
  return random.between(7.0 * field_s(scenario), scenario.video.length_s * 0.85);
}

// From one field to most of a second; never past the end, where there is nothing to come.
void draw_skip(RandomSource& random, Scenario& scenario) {
  Fault fault;
  fault.kind = FaultKind::kSkip;
  fault.at_s = some_time(random, scenario);
  const double most_s = scenario.video.length_s - fault.at_s;
  fault.for_s = std::min(
      random.chance(0.5) ? field_s(scenario) * random.whole(1, 8) : random.between(0.05, 0.7),
      most_s);
  scenario.faults.push_back(fault);
}

// One of the numbers that are not the place, up or down.
void draw_pose_step(RandomSource& random, Scenario& scenario) {
  Fault fault;
  fault.kind = FaultKind::kPoseStep;
  fault.at_s = some_time(random, scenario);
  const double sign = random.chance(0.5) ? 1.0 : -1.0;
  const std::int32_t number = random.whole(0, 3);
  if (number == 0) {
    fault.shake_mm[2] = sign * random.between(1.0, 8.0);
  } else {
    const std::array<double, 3> most_deg{3.0, 3.0, 8.0};
    const auto axis = static_cast<std::size_t>(number - 1);
    fault.shake_deg[axis] = sign * random.between(1.0, most_deg[axis]);
  }
  scenario.faults.push_back(fault);
}

// Under the end of a move, and now and then around it.
void draw_unlisted(RandomSource& random, const core::rendering::TubeEnds& ends,
                   Scenario& scenario) {
  std::vector<TubeAddress> places;
  for (const auto& segment : scenario.path) {
    if (segment.kind == SegmentKind::kMove) {
      places.push_back(ends.nearest(segment.to_mm).address);
    }
  }
  const auto from = ends.nearest({scenario.from.x_mm, scenario.from.y_mm}).address;
  std::erase(places, from);  // where the operator starts he sees what stands there
  if (places.empty()) {
    return;
  }
  const auto last = static_cast<std::int32_t>(places.size()) - 1;
  const TubeAddress chosen = places[static_cast<std::size_t>(random.whole(0, last))];
  const bool is_void = random.chance(0.5);
  const std::int32_t around = random.chance(0.3) ? 1 : 0;
  for (std::int32_t row = -around; row <= around; ++row) {
    for (std::int32_t column = -around; column <= around; ++column) {
      const TubeAddress address{chosen.row + row, chosen.column + column};
      if (address == from || ends.at(address).kind != TubeEndKind::kOpen ||
          core::tubesheet::check_address(scenario.scene.sheet, address) !=
              core::tubesheet::AddressFault::kNone) {
        continue;
      }
      static_cast<void>(is_void ? scenario.scene.sheet.missing.try_push_back(address)
                                : scenario.scene.plugs.try_push_back(
                                      {address, core::rendering::PlugKind::kFlush}));
    }
  }
}

}  // namespace

void draw_deceptions(const Stratum& stratum, std::uint64_t seed, std::int64_t move,
                     const core::rendering::TubeEnds& ends, Scenario& scenario) {
  // In the place of a jump by lattice steps, so that within [motion] stays what keeps to it.
  if (stratum.fault == FaultGroup::kJump && !scenario.faults.empty()) {
    RandomSource skip = random_stream(seed, move, "skip");
    RandomSource pose_step = random_stream(seed, move, "pose-step");
    if (skip.chance(0.4)) {
      scenario.faults.clear();
      draw_skip(skip, scenario);
    } else if (pose_step.chance(0.4)) {
      scenario.faults.clear();
      draw_pose_step(pose_step, scenario);
    }
  }
  RandomSource unlisted = random_stream(seed, move, "unlisted");
  if (unlisted.chance(0.1)) {
    draw_unlisted(unlisted, ends, scenario);
  }
}

}  // namespace tubesight::board::campaign
