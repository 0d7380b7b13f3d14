#pragma once

#include <cstdint>
#include <vector>

#include "core/detection/lattice_finder.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::board {

/// A place of a lattice found, by its numbering.
struct LatticePlace {
  std::int32_t row = 0;
  std::int32_t column = 0;
};

/// Places among the elements of a dark lattice where the picture is as bright as the sheet around
/// them: plugs, or no tubes. Neighbours on most sides must be found, so that nothing is hidden.
[[nodiscard]] std::vector<LatticePlace> find_gaps(const core::detection::FoundLattice& found,
                                                  const core::picture::AveragedPicture& picture);

}  // namespace tubesight::board
