#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "drivers/settings/settings_problems.h"
#include "drivers/simulated/scenario.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::drivers {

/// Where the keys of a fault stand, for messages.
struct FaultPlaces {
  std::string name;  ///< of the table: "fault[0]"
  drivers::SettingsPlace at_s;
  drivers::SettingsPlace for_s;
  drivers::SettingsPlace steps;
};

/// Where the time of an event comes from, for messages.
struct EventPlace {
  std::string key;  ///< "event[0].at_s", "step[2].claim"
  drivers::SettingsPlace place;
  bool of_path = false;  ///< a step's claim, which a recording shorter than the path may leave out
};

/// Adds a problem for each fault that hits no field, and for each jump that would put the tool off
/// the sheet. `world` plays `scenario`; `places` has an entry a fault, in their order.
void check_faults(const drivers::Scenario& scenario, const drivers::SimulatedWorld& world,
                  std::span<const FaultPlaces> places, drivers::SettingsProblems& problems);

/// Adds a problem for each event of which the box would never be told, but for starts, whose clicks
/// need a field anyway. `places` has an entry an event, in their order.
void check_events(const drivers::Scenario& scenario, const drivers::SimulatedWorld& world,
                  std::span<const EventPlace> places, drivers::SettingsProblems& problems);

}  // namespace tubesight::drivers
