#pragma once

#include <cstdint>
#include <string>

#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {

/// The table `[journal]`: what was verified, kept for years.
struct JournalSettings {
  std::string file;              ///< empty: none is kept
  std::string key;               ///< that signs it
  std::int32_t pictures = 2000;  ///< kept, the newest ones

  [[nodiscard]] bool wanted() const { return !file.empty(); }
};

/// Reads the table; neither file is looked for, as both may come.
void read_journal(const drivers::SettingsDocument& document, drivers::TableReader& table,
                  JournalSettings& journal);

}  // namespace tubesight::board
