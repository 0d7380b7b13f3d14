#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/sighting.h"
#include "core/overlay/painter.h"

namespace tubesight::core::overlay {

/// Height of the readout's box at the bottom of a picture; 0 where the picture is too small for it.
///
/// The box takes a third of the picture at most; pictures below 320 px in width have none.
[[nodiscard]] std::int32_t readout_height_px(std::int32_t width_px, std::int32_t height_px);

/// Draws the black box at the picture's bottom edge: what the box knows, in words and numbers.
///
/// Left: row (red) and column (yellow) of the primary tube, the number of tube-ends tracked, state
/// and reason. Right: row and column of the tube above the guidetube (blue), ALIGNED in a filled
/// green box or "not aligned" in grey, offset and height, field and time. Numbers that are not
/// known are dashes. What would not fit whole is written smaller, and left out if that does not
/// help.
void draw_readout(Painter& painter, const Sighting& sighting, std::optional<std::int64_t> field);

/// The state as the operator reads it, in capitals.
[[nodiscard]] std::string_view state_words(TrackState state);

}  // namespace tubesight::core::overlay
