#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/sighting.h"
#include "core/overlay/mark_scale.h"
#include "core/overlay/overlay.h"
#include "core/overlay/painter.h"
#include "core/overlay/pixels.h"

/// The marks laid over the picture, one function each; draw_overlay calls them in order.
///
/// Lengths named here are those of a picture 640 px in width, see MarkScale.
namespace tubesight::core::overlay {

/// Draws the search window's edges, on the window's own outermost pixels.
void draw_search_window(Painter& painter, MarkScale scale, const PixelBox& window);

/// Draws the optimum point: a small open diamond in the window's colour.
void draw_optimum(Painter& painter, MarkScale scale, PixelPoint at);

/// Draws expected places: a dot for an open tube, a small box for a plug, a small x for none, and
/// addresses as draw_addresses() does.
void draw_estimates(Painter& painter, MarkScale scale, std::span<const Estimate> estimates);

/// Draws one measured tube-end: magenta box for a plug, orange x for a rejected one (quality 0),
/// green cross-hair for a used one.
void draw_tube(Painter& painter, MarkScale scale, const TubeSighting& tube);

/// Draws the pale ring, 5 px in radius, where the guidetube's axis meets the sheet.
void draw_axis_point(Painter& painter, MarkScale scale, PixelPoint at);

/// Draws the blue arrow from a tube's centre to the ring around the guidetube's axis; nothing where
/// they are too near to each other for an arrow.
void draw_offset(Painter& painter, MarkScale scale, ImagePoint tube, ImagePoint axis);

/// Draws the blue frame around the rim of the tube above the guidetube: the whole frame when
/// `aligned`, its corners alone otherwise. What is inside stays free. `rim` is half of the rim's
/// size; 30 px where it is not known.
void draw_tool(Painter& painter, MarkScale scale, PixelPoint at, std::optional<HalfSize> rim,
               bool aligned);

/// Draws the row axis (red, with an R) and the column axis (yellow, with a C) of the primary tube.
///
/// Each points to the neighbour's centre, from two fifths to four fifths of the way, so that the
/// tube-end stays free; a direction that is not known is left out. A white dot stands on the pixel
/// nearest to `origin`.
void draw_axes(Painter& painter, MarkScale scale, ImagePoint origin,
               std::optional<ImagePoint> next_row, std::optional<ImagePoint> next_column);

/// Draws the sign of no entry on the tube that the robot claims and the box contradicts.
void draw_contradicted_claim(Painter& painter, MarkScale scale, PixelPoint at);

/// Draws a pin whose tip stands on the place clicked, with the address above it: pale when its
/// start was taken, red when it was refused, and filled when this click is to blame.
void draw_click(Painter& painter, MarkScale scale, const Click& click);

}  // namespace tubesight::core::overlay
