#pragma once

#include <vector>

#include "board/bench/simulate/scenario_clicks.h"
#include "core/base/settings.h"
#include "drivers/settings/settings_document.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::board {

/// Reads each `[[event]]` and appends it to `events`; the clicks of starts are wished for in
/// `wishes`. `length_s` is the recording's.
void read_events(drivers::SettingsDocument& document, const core::SessionSettings& told,
                 double length_s, std::vector<drivers::ScenarioEvent>& events,
                 std::vector<ClickWish>& wishes);

}  // namespace tubesight::board
