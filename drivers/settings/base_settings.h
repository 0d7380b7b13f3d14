#pragma once

#include <array>
#include <string>

#include "core/base/result.h"
#include "drivers/files/messages.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::drivers {

/// `[base]`: T_sheet_base.
struct BaseSettings {
  std::array<double, 3> position_mm{};
  std::array<double, 3> rotation_deg{};  ///< alpha, beta, gamma
};

void read_base(TableReader& table, BaseSettings& base);

/// Reads `[base]` of a settings file, which may have a session's other tables, too. Errors:
/// kInvalidArgument, with one message for each mistake.
[[nodiscard]] core::Result<void> load_base_settings(const std::string& path, BaseSettings& base,
                                                    Messages& messages);

}  // namespace tubesight::drivers
