#pragma once

#include <string>
#include <string_view>

#include "core/detection/lattice_finder.h"

namespace tubesight::board {

/// First line of `look --csv`, without the line feed.
inline constexpr std::string_view kLookHeader = "image,row,column,u_px,v_px,diameter_px";

/// Appends a row for each element of a picture, in the order of rows and columns.
void append_look_rows(std::string& out, const std::string& image,
                      const core::detection::FoundLattice& found);

/// What was found in a picture, in a few lines for a person: kind of lattice, how many elements,
/// pitch over diameter, angle between the steps, sizes.
[[nodiscard]] std::string look_text(const std::string& image,
                                    const core::detection::FoundLattice& found);

/// Why nothing was found, in a few words; docs/messages.md tells more.
[[nodiscard]] std::string_view explain(core::detection::FinderRefusal refusal);

}  // namespace tubesight::board
