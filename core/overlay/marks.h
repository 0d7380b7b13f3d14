#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/sighting.h"
#include "core/overlay/overlay.h"
#include "core/overlay/painter.h"
#include "core/overlay/pixels.h"

/// The marks laid over the picture, one function each; draw_overlay calls them in order.
namespace tubesight::core::overlay {

/// Draws the search window's edges, one pixel wide, on the window's own outermost pixels.
void draw_search_window(Painter& painter, const PixelBox& window);

/// Draws the optimum point: a small open diamond in the window's colour.
void draw_optimum(Painter& painter, PixelPoint at);

/// Draws expected places: a dot for an open tube, a small box for a plug, a small x for none.
///
/// An address is written beneath a dot where no other estimate is near enough to be written over.
void draw_estimates(Painter& painter, std::span<const Estimate> estimates);

/// Draws one measured tube-end: magenta box for a plug, orange x for a rejected one (quality 0),
/// green cross-hair for a used one.
void draw_tube(Painter& painter, const TubeSighting& tube);

/// Draws the pale ring, 5 px in radius, where the guidetube's axis meets the sheet.
void draw_axis_point(Painter& painter, PixelPoint at);

/// Draws the large blue cross-hair; its middle is filled when `aligned` and open otherwise.
void draw_tool(Painter& painter, PixelPoint at, bool aligned);

/// Draws the L of row axis (red) and column axis (yellow) at the primary tube.
///
/// Each points to the neighbour's centre and ends after four fifths of the way; a direction that is
/// not known is left out. The corner is a white dot on the pixel nearest to `origin`.
void draw_axes(Painter& painter, ImagePoint origin, std::optional<ImagePoint> next_row,
               std::optional<ImagePoint> next_column);

}  // namespace tubesight::core::overlay
