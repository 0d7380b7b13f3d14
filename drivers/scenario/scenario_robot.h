#pragma once

#include <string>

#include "drivers/settings/settings_document.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::drivers {

/// Reads `[robot]`, where it stands: the arm that carries the path out and what is wrong with it.
/// Without the table the scenario has no robot. Says whether all was well.
bool read_robot(drivers::SettingsDocument& document, drivers::Scenario& scenario);

/// Why the scenario's robot cannot carry its path out, in a message's words; empty: it can, or
/// there is none.
[[nodiscard]] std::string why_robot_cannot(const drivers::Scenario& scenario);

}  // namespace tubesight::drivers
