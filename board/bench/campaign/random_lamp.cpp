// Draws a run of a box that rules its lamp.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "board/bench/campaign/lamp_run.h"
#include "board/bench/campaign/random_parts.h"
#include "board/bench/campaign/random_stream.h"
#include "core/tubesheet/sheet_places.h"

namespace tubesight::board::campaign {
namespace {

using core::kinematics::PathSegment;
using core::kinematics::SegmentKind;
using core::kinematics::ToolPath;
using core::kinematics::ToolPlace;
using core::rendering::TubeEndKind;
using core::rendering::TubeEnds;
using drivers::Fault;
using drivers::FaultKind;
using drivers::Scenario;

/// Of the strata of a campaign's moves, those without faults and slow: their plants and cameras.
constexpr std::int32_t kPlainStrata = 8;

constexpr double kSound_s = 20.0;
/// Until then a picture is proved live, but for the slowest of bulbs on the move.
constexpr double kFirstFault_s = 4.0;
constexpr double kLastFault_s = 8.0;
/// Longer than a fault may go without its name.
constexpr double kAfter_s = 12.0;

/// Draws where the tool goes.
class LampPath {
 public:
  LampPath(RandomSource& random, const TubeEnds& ends, Scenario& scenario)
      : random_(random), ends_(ends), scenario_(scenario) {}

  /// Keeps the place under which the operator clicked.
  void draw(LampMotion motion, double fault_s, double length_s) {
    scenario_.path.clear();
    static_cast<void>(path_->begin(scenario_.from));
    double rest_s = 0.2;
    if (motion == LampMotion::kRests) {
      rest_s = length_s;
    } else if (motion == LampMotion::kGoesOn) {
      rest_s = fault_s + random_.between(0.0, 3.0);
    }
    add_rest(rest_s);
    if (motion != LampMotion::kRests && path_->end().height_mm < kLow_mm) {
      add_height();
    }
    while (path_->duration_s() < length_s) {
      add_move();
      add_rest(random_.between(0.05, 0.4));
    }
  }

 private:
  /// Nothing moves sideways with the guidetube nearer to the sheet.
  static constexpr double kLow_mm = 38.0;

  void append(const PathSegment& segment) {
    if (path_->add(segment)) {
      scenario_.path.push_back(segment);
    }
  }

  void add_rest(double rest_s) {
    PathSegment segment;
    segment.kind = SegmentKind::kRest;
    segment.rest_s = rest_s;
    append(segment);
  }

  void add_height() {
    PathSegment segment;
    segment.kind = SegmentKind::kHeight;
    segment.height_mm = random_.between(kLow_mm, 75.0);
    segment.limits = {random_.between(30.0, 100.0), 1000.0, 30000.0};
    append(segment);
  }

  /// By one to six pitches, to an open tube well inside the sheet.
  void add_move() {
    const ToolPlace from = path_->end();
    const double pitch = pitch_mm(scenario_.scene.sheet);
    PathSegment segment;
    segment.kind = SegmentKind::kMove;
    segment.to_mm = {from.x_mm, from.y_mm};
    segment.limits = {random_.between(30.0, 150.0), random_.between(600.0, 2800.0), 50000.0};
    for (int tries = 0; tries < 50; ++tries) {
      const double way = random_.between(pitch, 6.0 * pitch);
      const double heading = random_.between(0.0, 2.0 * std::numbers::pi);
      const auto tube =
          ends_.nearest({from.x_mm + way * std::cos(heading), from.y_mm + way * std::sin(heading)});
      const auto& [row, column] = tube.address;
      if (tube.kind == TubeEndKind::kOpen && std::min(row, column) >= 3 &&
          std::max(row, column) <= kLastAddress - 3) {
        const std::array<double, 2> there = ends_.lattice_point(tube.address);
        segment.to_mm = {there[0] + random_.normal(0.4), there[1] + random_.normal(0.4)};
        break;
      }
    }
    append(segment);
  }

  RandomSource& random_;
  const TubeEnds& ends_;
  Scenario& scenario_;
  std::unique_ptr<ToolPath> path_ = std::make_unique<ToolPath>();
};

/// A lamp, and the camera's LEDs beside it.
void draw_light(RandomSource& random, LampFault fault, drivers::SimulatedLight& light) {
  light.lag_s = random.chance(0.3) ? 0.0 : random.between(0.02, 0.25);
  light.ring = random.chance(0.5) ? 0.0 : random.between(0.05, 0.6);
  if (fault == LampFault::kDead && random.chance(0.3)) {
    light.ring = 0.0;
  }
}

void draw_elsewhere(RandomSource& random, const core::TubesheetSettings& sheet, Fault& fault) {
  do {
    fault.rows = random.whole(-2, 2);
    fault.columns = random.whole(-2, 2);
  } while ((fault.rows == 0 && fault.columns == 0) ||
           core::tubesheet::check_move(sheet, {fault.rows, fault.columns}) !=
               core::tubesheet::MoveFault::kNone);
}

/// The fault of a run, from `at_s` on; how long it takes to come.
double draw_fault(RandomSource& random, LampFault kind, double at_s, Scenario& scenario) {
  scenario.faults.clear();
  Fault fault;
  fault.at_s = at_s;
  switch (kind) {
    case LampFault::kNone: return 0.0;
    case LampFault::kDead: fault.kind = FaultKind::kLampOut; break;
    case LampFault::kFades:
      fault.kind = FaultKind::kLampDrift;
      fault.for_s = random.between(2.0, 10.0);
      fault.level = random.between(0.0, 0.05);
      break;
    case LampFault::kFrozen: fault.kind = FaultKind::kFrozen; break;
    case LampFault::kOtherCamera:
      fault.kind = FaultKind::kOtherCamera;
      draw_elsewhere(random, scenario.scene.sheet, fault);
      break;
  }
  scenario.faults.push_back(fault);
  return fault.for_s;
}

}  // namespace

LampRun LampRunMaker::make(std::uint64_t seed, std::int64_t number, Scenario& scenario) {
  LampRun run;
  const auto kind = static_cast<std::int32_t>(number % kLampKinds);
  run.fault = static_cast<LampFault>(kind % kLampFaults);
  run.motion = static_cast<LampMotion>(kind / kLampFaults);
  moves_.make(seed, number * kStrata + number / kLampKinds % kPlainStrata, scenario);
  RandomSource random = random_stream(seed, number, "lamp run");
  static_cast<void>(truth_->configure(scenario.scene));  // as it went well for the move
  draw_light(random, run.fault, scenario.light);
  const double begins_s = random.between(kFirstFault_s, kLastFault_s);
  const double takes_s = draw_fault(random, run.fault, begins_s, scenario);
  run.fault_s = begins_s + takes_s;
  const bool sound = run.fault == LampFault::kNone;
  scenario.video.length_s = sound ? kSound_s : run.fault_s + kAfter_s;
  scenario.video.window_margin_px = 4;
  LampPath(random, truth_->tube_ends(), scenario)
      .draw(run.motion, begins_s, scenario.video.length_s);
  run.policy.follows_picture = true;
  run.policy.pattern = true;
  run.policy.seed = static_cast<std::uint32_t>(random.whole(1, 2'000'000'000));
  return run;
}

}  // namespace tubesight::board::campaign
