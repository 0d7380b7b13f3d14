#pragma once

#include <cstdint>
#include <vector>

#include "core/base/image_view.h"
#include "core/detection/lattice_finder.h"

namespace tubesight::board {

/// Draws what was found over its picture: the ellipses (green: edge measured, orange: by their
/// pixels), the centres' images (white crosses), rows (red) and columns (yellow) as joins of
/// neighbours, and row and column where there is room. `pixels` is replaced; the view is valid as
/// long as it is.
[[nodiscard]] core::RgbImageView draw_lattice(const core::ImageView& picture,
                                              const core::detection::FoundLattice& found,
                                              std::vector<std::uint8_t>& pixels);

}  // namespace tubesight::board
