#include "drivers/scenario/scenario_effects.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/tubesheet/sheet_places.h"
#include "drivers/settings/session_checks.h"
#include "drivers/simulated/tool_motion.h"

namespace tubesight::drivers {
namespace {

using drivers::Fault;
using drivers::FaultKind;
using drivers::Scenario;
using drivers::SimulatedWorld;

double end_of(const Fault& fault) {
  return fault.for_s > 0.0 ? fault.at_s + fault.for_s : std::numeric_limits<double>::infinity();
}

void complain_of_idle_fault(const Fault& fault, const FaultPlaces& places,
                            drivers::SettingsProblems& problems) {
  if (fault.for_s <= 0.0) {
    problems.push_back({places.at_s, places.name +
                                         ".at_s: no field is left from then on, expected an "
                                         "earlier time"});
    return;
  }
  problems.push_back({places.for_s, places.name + ".for_s: " +
                                        (drivers::by_frames(fault.kind) ? "no frame begins in it"
                                                                        : "no field lies in it") +
                                        ", expected longer or another at_s"});
}

/// The jumps of a scenario and the path that they act on.
class JumpCheck {
 public:
  JumpCheck(const Scenario& scenario, const SimulatedWorld& world)
      : scenario_(scenario),
        path_(world.path()),
        end_s_(drivers::seconds_of(world.slot_time(world.slots()))) {}

  void run(std::span<const FaultPlaces> places, drivers::SettingsProblems& problems) {
    std::vector<bool> told(scenario_.faults.size(), false);
    for (const double time_s : instants()) {
      // Moves are straight and the sheet has no bays: off it anywhere is off it at an instant at
      // which something begins or ends, by what is at work before or after.
      for (const bool after : {false, true}) {
        std::size_t last = 0;
        const std::string wrong = why_off(time_s, after, last);
        if (!wrong.empty() && !told[last]) {
          told[last] = true;
          problems.push_back({places[last].steps, places[last].name + ".steps: " + wrong});
        }
      }
    }
  }

 private:
  [[nodiscard]] std::vector<double> instants() const {
    std::vector<double> all;
    for (const Fault& fault : scenario_.faults) {
      if (fault.kind == FaultKind::kJump) {
        all.push_back(fault.at_s);
        all.push_back(end_of(fault));
      }
    }
    if (all.empty()) {
      return all;
    }
    for (std::int32_t segment = 0; segment < path_.size(); ++segment) {
      all.push_back(path_.start_s(segment));
    }
    all.push_back(path_.duration_s());
    for (double& time_s : all) {
      time_s = std::min(time_s, end_s_);
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// What is wrong with where the tool is just before or after an instant; `last` is the jump that
  /// began last. Empty without a jump at work, too.
  [[nodiscard]] std::string why_off(double time_s, bool after, std::size_t& last) const {
    core::TubeAddress by{};
    double latest_s = -1.0;
    for (std::size_t i = 0; i < scenario_.faults.size(); ++i) {
      const Fault& fault = scenario_.faults[i];
      const bool at_work = after ? fault.at_s <= time_s && time_s < end_of(fault)
                                 : fault.at_s < time_s && time_s <= end_of(fault);
      if (fault.kind != FaultKind::kJump || !at_work) {
        continue;
      }
      by = {by.row + fault.rows, by.column + fault.columns};
      if (fault.at_s >= latest_s) {
        latest_s = fault.at_s;
        last = i;
      }
    }
    if (latest_s < 0.0 || (after && time_s >= end_s_)) {
      return {};
    }
    const core::TubesheetSettings& sheet = scenario_.told.tubesheet;
    const auto place = path_.state_at(time_s).place;
    const auto jumped_mm = core::tubesheet::move_mm(sheet, by);
    return drivers::why_off_the_sheet(sheet,
                                      {place.x_mm + jumped_mm[0], place.y_mm + jumped_mm[1]});
  }

  const Scenario& scenario_;
  const core::kinematics::ToolPath& path_;
  double end_s_;
};

}  // namespace

void check_faults(const Scenario& scenario, const SimulatedWorld& world,
                  std::span<const FaultPlaces> places, drivers::SettingsProblems& problems) {
  for (std::size_t i = 0; i < scenario.faults.size(); ++i) {
    if (!world.hits(scenario.faults[i])) {
      complain_of_idle_fault(scenario.faults[i], places[i], problems);
    }
  }
  JumpCheck(scenario, world).run(places, problems);
}

void check_events(const Scenario& scenario, const SimulatedWorld& world,
                  std::span<const EventPlace> places, drivers::SettingsProblems& problems) {
  // As the world: times that should be equal differ in their last bits.
  constexpr double kNothing_s = 1e-9;
  const double end_s = drivers::seconds_of(world.slot_time(world.slots() - 1)) + kNothing_s;
  const std::int64_t slot = world.last_delivered();
  const double last_s = slot >= 0 ? drivers::seconds_of(world.slot_time(slot)) + kNothing_s : -1.0;
  const bool cut = world.path().duration_s() > drivers::seconds_of(world.slot_time(world.slots()));
  for (std::size_t i = 0; i < scenario.events.size(); ++i) {
    const drivers::ScenarioEvent& told = scenario.events[i];
    if (told.at_s <= last_s || core::content_if<core::Start>(told.event) != nullptr ||
        (cut && places[i].of_path && told.at_s > end_s)) {
      continue;
    }
    problems.push_back({places[i].place, places[i].key +
                                             ": no field is delivered from then on, expected an "
                                             "earlier time"});
  }
}

}  // namespace tubesight::drivers
