#pragma once

#include <string>

#include "core/base/result.h"
#include "core/kinematics/serial_arm.h"
#include "drivers/files/messages.h"
#include "drivers/settings/settings_document.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::drivers {

/// Reads `[robot]`, where it stands: the arm that carries the path out and what is wrong with it.
/// Without the table the scenario has no robot. Says whether all was well.
bool read_robot(drivers::SettingsDocument& document, drivers::Scenario& scenario);

/// Reads the arm of a file whose `[robot]` has `links` and `tool_mm` alone (`near_deg` may stand
/// there); `[base]` beside it is passed over. Errors: kInvalidArgument, with one message for each
/// mistake.
[[nodiscard]] core::Result<void> load_arm(const std::string& path, core::kinematics::SerialArm& arm,
                                          drivers::Messages& messages);

/// Why the scenario's robot cannot carry its path out, in a message's words; empty: it can, or
/// there is none.
[[nodiscard]] std::string why_robot_cannot(const drivers::Scenario& scenario);

}  // namespace tubesight::drivers
