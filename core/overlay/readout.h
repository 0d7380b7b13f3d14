#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/sighting.h"
#include "core/overlay/overlay.h"
#include "core/overlay/painter.h"

namespace tubesight::core::overlay {

/// Height of the readout below a camera's picture of this width, an even number; 0 below 320 px,
/// where it could not be read.
[[nodiscard]] std::int32_t readout_height_px(std::int32_t width_px);

/// Fills a picture of readout_height_px() with what the box knows, in words and numbers on black.
///
/// Left: row (red) and column (yellow) of the primary tube, the number of tube-ends tracked, state,
/// and the residual of a judged field. Right: row and column of the tube above the guidetube
/// (blue), ALIGNED in a filled green box or "not aligned" in amber, offset and height, field and
/// time, and a dial: its ring is the offset up to which the tube is aligned, its arrow leads from
/// the tube's centre to the guidetube's axis as seen in the picture, and ends at the dial's edge
/// where that is farther. Below: up to two messages (messages.h). Numbers that are not known are
/// dashes. What would not fit whole is written smaller or shorter, and left out if that does not
/// help.
void draw_readout(Painter& painter, const OverlayInput& input);

/// The state as the operator reads it, in capitals.
[[nodiscard]] std::string_view state_words(TrackState state);

}  // namespace tubesight::core::overlay
