#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/base/tube_address.h"
#include "core/overlay/mark_scale.h"
#include "core/overlay/overlay.h"
#include "core/overlay/painter.h"
#include "core/overlay/pixels.h"
#include "core/overlay/text_line.h"

/// Addresses written beside marks.
namespace tubesight::core::overlay {

/// The colour of a tube expected in this state, and of its address.
[[nodiscard]] Rgb estimate_colour(TubeState state);

/// "40,61".
[[nodiscard]] TextLine address_text(TubeAddress address);

/// The box of words that are centred about the column `middle_px` and whose letters' tops stand on
/// the line `top_px`.
[[nodiscard]] PixelBox label_box(std::int32_t middle_px, std::int32_t top_px,
                                 std::string_view words, MarkScale scale);

/// Writes words on black into their label_box(); nothing where the picture does not hold all of it.
void draw_label(Painter& painter, MarkScale scale, const PixelBox& box, std::string_view words,
                Rgb colour);

/// Writes the address of each tube beneath its centre, where no other one's centre or address is
/// near enough to be written over; none where no tube is. n^2 comparisons.
void draw_addresses(Painter& painter, MarkScale scale, std::span<const Estimate> tubes);

}  // namespace tubesight::core::overlay
