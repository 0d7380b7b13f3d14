#pragma once

#include <array>
#include <string_view>

#include "drivers/aravis/aravis_settings.h"
#include "drivers/settings/table_reader.h"
#include "drivers/v4l2/v4l2_settings.h"

namespace tubesight::board {

/// The keys of `[source]` that cameras of all kinds have, and those that one kind alone has.
inline constexpr std::array<std::string_view, 4> kCameraKeys = {"device", "format", "fields_per_s",
                                                                "exposure_ms"};
inline constexpr std::array<std::string_view, 5> kV4l2Keys = {"fields", "input", "standard",
                                                              "stamps", "controls"};
inline constexpr std::array<std::string_view, 8> kAravisKeys = {
    "left_px", "top_px", "binning", "gain", "trigger", "packet_bytes", "resend", "readout_ms"};

/// Read the keys; mistakes go to the reader's problems. What comes from the session is left as it
/// is.
void read_v4l2(drivers::TableReader& table, drivers::V4l2Settings& camera);
void read_aravis(drivers::TableReader& table, drivers::AravisSettings& camera);

}  // namespace tubesight::board
