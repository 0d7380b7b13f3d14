#pragma once

#include <cstdint>

#include "core/overlay/overlay.h"
#include "core/overlay/painter.h"
#include "core/overlay/pixels.h"

namespace tubesight::core::overlay {

/// Draws how far the guidetube's axis is off the tube's centre, and to which side of the picture.
///
/// The ring, seven tenths of `radius_px`, is the offset up to which the tube is aligned: green and
/// twice as thick when it is, amber when not, grey when no tube is known. The arrow leads from the
/// middle, which is the tube's centre, to the axis, as the picture shows it; it ends at `radius_px`
/// where the axis is farther off. Lines are `line_px` thick. 8 <= radius_px < 4096.
void draw_dial(Painter& painter, PixelPoint center, std::int32_t radius_px, std::int32_t line_px,
               const OverlayInput& input);

}  // namespace tubesight::core::overlay
