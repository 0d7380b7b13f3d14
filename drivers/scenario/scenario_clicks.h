#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/settings.h"
#include "drivers/settings/table_reader.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::drivers {

/// Clicks that are to be made of the truth: of which tubes, how far off, at what time.
struct ClickWish {
  std::vector<core::TubeAddress> tubes;  ///< empty: chosen from what the picture shows
  double off_center = 0.3;  ///< share of the rim's half extent that a click is off its middle
  double at_s = 0.0;
  drivers::SettingsPlace place;  ///< of the table, for messages
  std::string name;              ///< of the table
  std::ptrdiff_t event = -1;     ///< index in Scenario::events; below 0: `[start]` itself
};

/// Reads `click_on` and `off_center`.
void read_click_wish(drivers::TableReader& table, const core::TubesheetSettings& sheet,
                     ClickWish& wish);

/// Makes the clicks in the first field that is delivered from the wish's time on; empty when all is
/// well, else what is wrong and what was expected.
[[nodiscard]] std::string make_clicks(const ClickWish& wish, const drivers::Scenario& scenario,
                                      drivers::SimulatedWorld& world,
                                      decltype(core::StartSettings::tubes)& clicks);

}  // namespace tubesight::drivers
