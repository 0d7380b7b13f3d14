#pragma once

#include <string>
#include <vector>

#include "core/calibration/zone_field.h"

namespace tubesight::board {

/// Reads zone corrections (docs/file-formats.md). False, and a line in `messages` for each bad row.
[[nodiscard]] bool read_zones(const std::string& path, core::calibration::ZonePoints& points,
                              std::vector<std::string>& messages);

/// The text of such a file.
[[nodiscard]] std::string zones_text(const core::calibration::ZonePoints& points);

}  // namespace tubesight::board
