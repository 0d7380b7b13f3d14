#pragma once

#include <cstdint>

#include "core/overlay/mark_scale.h"
#include "core/overlay/painter.h"
#include "core/overlay/pixels.h"

/// Marks of pictures at rest, in which rims are measured all around: of `pose` and `look`.
namespace tubesight::core::overlay {

/// What became of a tube-end's rim.
enum class RimMark : std::uint8_t {
  kUsed,         ///< measured and used
  kRejected,     ///< measured, but not believed
  kClosed,       ///< nothing dark inside: a plug
  kNotMeasured,  ///< expected there, and not measured
};

/// The colour of the rim, of its centre's mark and of its address.
[[nodiscard]] Rgb colour_of(RimMark mark);

/// Draws the mark at the centre of a rim: a green cross-hair for a used one, an orange x for a
/// rejected one, a magenta box for a closed one, a grey dot for one that was not measured.
void draw_rim_centre(Painter& painter, MarkScale scale, PixelPoint at, RimMark mark);

/// Draws one stretch of a rim's outline, in its colour.
void draw_rim_stretch(Painter& painter, MarkScale scale, PixelPoint from, PixelPoint to,
                      RimMark mark);

/// Draws one point of the edge that was found, in white.
void draw_edge_point(Painter& painter, MarkScale scale, PixelPoint at);

}  // namespace tubesight::core::overlay
