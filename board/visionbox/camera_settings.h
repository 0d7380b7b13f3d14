#pragma once

#include <array>
#include <string_view>

#include "drivers/settings/table_reader.h"
#include "drivers/v4l2/v4l2_settings.h"

namespace tubesight::board {

/// The keys of `[source]` that a camera behind V4L2 has, and others do not.
inline constexpr std::array<std::string_view, 9> kV4l2Keys = {
    "device",       "format",      "fields", "input",   "standard",
    "fields_per_s", "exposure_ms", "stamps", "controls"};

/// Reads them; mistakes go to the reader's problems. What comes from the session is left as it is.
void read_v4l2(drivers::TableReader& table, drivers::V4l2Settings& camera);

}  // namespace tubesight::board
