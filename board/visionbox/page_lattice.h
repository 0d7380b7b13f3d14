#pragma once

#include <array>
#include <vector>

#include "board/visionbox/page_json.h"
#include "core/base/image_view.h"
#include "core/base/settings.h"

namespace tubesight::board {

/// How the tubes of a lattice that was found in a picture may be numbered: row = a i + b j + r0,
/// column = c i + d j + c0.
struct LatticeWay {
  std::int32_t a = 0;
  std::int32_t b = 0;
  std::int32_t c = 0;
  std::int32_t d = 0;

  friend constexpr bool operator==(const LatticeWay&, const LatticeWay&) = default;
};

/// All ways in which a sheet's numbering may lie on a lattice with these steps from one tube to the
/// next in i and in j, as seen by the level tool in any unit: those turns by which lengths, angle
/// and handedness agree with the sheet's steps. None where rows are shifted against each other: no
/// such numbers describe that.
[[nodiscard]] std::vector<LatticeWay> lattice_ways(const core::TubesheetSettings& sheet,
                                                   const std::array<double, 2>& i,
                                                   const std::array<double, 2>& j);

/// Looks for the lattice of tube-ends in a picture, cold; some tenths of a second.
[[nodiscard]] Json find_page_lattice(const core::ImageView& picture,
                                     const core::SessionSettings& told);

}  // namespace tubesight::board
