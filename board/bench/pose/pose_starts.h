#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/settings.h"
#include "core/base/tube_address.h"
#include "core/pose/picture_pose.h"

namespace tubesight::board {

using PictureStarts = std::vector<core::pose::PictureStart>;

/// Reads "R,C,U,V;R,C,U,V;…": row, column, and a place inside the dark in full-frame pixels. False,
/// with one line in `message`, when it is anything else.
[[nodiscard]] bool parse_starts(std::string_view text, PictureStarts& starts, std::string& message);

/// Says in one line what is wrong with places for this camera and tubesheet: outside the picture,
/// an address that the sheet does not have, that is listed as missing or plugged, or named twice.
/// Empty when all is well.
[[nodiscard]] std::string why_starts_wrong(const PictureStarts& starts,
                                           const core::SessionSettings& settings);

/// Reads "ROW,COLUMN".
[[nodiscard]] bool parse_address(std::string_view text, core::TubeAddress& address);

}  // namespace tubesight::board
