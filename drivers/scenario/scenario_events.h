#pragma once

#include <vector>

#include "core/base/settings.h"
#include "drivers/scenario/scenario_clicks.h"
#include "drivers/scenario/scenario_effects.h"
#include "drivers/settings/settings_document.h"
#include "drivers/settings/toml_writer.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::drivers {

/// What events are read into.
struct ScenarioEvents {
  std::vector<drivers::ScenarioEvent>* events;
  std::vector<EventPlace>* places;  ///< one an event
  std::vector<ClickWish>* wishes;   ///< for the clicks of starts
};

/// Reads each `[[event]]` and appends it. `length_s` is the recording's.
void read_events(drivers::SettingsDocument& document, const core::SessionSettings& told,
                 double length_s, ScenarioEvents to);

/// Writes an event as an `[[event]]`, which reads back as it was.
void write_event(drivers::TomlWriter& toml, const drivers::ScenarioEvent& told);

}  // namespace tubesight::drivers
