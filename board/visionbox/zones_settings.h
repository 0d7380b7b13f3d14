#pragma once

#include <string>

#include "core/calibration/zone_field.h"
#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {

/// The table `[zones]`: the robot's corrections by zones.
struct ZonesSettings {
  std::string file;  ///< empty: there are none
  core::calibration::ZonePoints points;

  [[nodiscard]] bool wanted() const { return !points.empty(); }
};

/// Reads the table, and the file that it names. `link`: a robot can ask.
void read_zones(const drivers::SettingsDocument& document, drivers::TableReader& table, bool link,
                ZonesSettings& zones);

}  // namespace tubesight::board
