#pragma once

#include <vector>

#include "core/base/settings.h"
#include "drivers/scenario/scenario_effects.h"
#include "drivers/settings/settings_document.h"
#include "drivers/settings/toml_writer.h"
#include "drivers/simulated/fault.h"

namespace tubesight::drivers {

/// What faults are judged against.
struct FaultContext {
  double length_s = 0.0;  ///< of the recording; 0: not known, nothing is checked against it
  bool interlaced = true;
  const core::TubesheetSettings* sheet = nullptr;  ///< not null
};

/// Reads each `[[fault]]` into `faults`, replacing them, and where it stands into `places`. Says
/// whether all was well.
bool read_faults(drivers::SettingsDocument& document, const FaultContext& context,
                 std::vector<drivers::Fault>& faults, std::vector<FaultPlaces>& places);

/// Writes a fault as a `[[fault]]`, which reads back as it was.
void write_fault(drivers::TomlWriter& toml, const drivers::Fault& fault);

}  // namespace tubesight::drivers
