#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tubesight::drivers {

/// A place in one of the settings files.
struct SettingsPlace {
  std::int32_t file = 0;  ///< index in the order in which the files were opened
  std::int64_t line = 1;  ///< 0: of the file as a whole
};

/// One mistake: "file:line: " is put before `text` when all are told.
struct SettingsProblem {
  SettingsPlace place;
  std::string text;
};

/// Mistakes in the order in which they were found.
using SettingsProblems = std::vector<SettingsProblem>;

}  // namespace tubesight::drivers
