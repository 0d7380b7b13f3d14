#pragma once

#include <string>

#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {

/// The table `[pairs]`: poses by the robot and by the box, side by side.
struct PairsSettings {
  std::string file;  ///< empty: none are written

  [[nodiscard]] bool wanted() const { return !file.empty(); }
};

/// Reads the table. A file that is there must be one of pairs; one that is not there may come, and
/// so may its folder.
void read_pairs(const drivers::SettingsDocument& document, drivers::TableReader& table,
                PairsSettings& pairs);

}  // namespace tubesight::board
