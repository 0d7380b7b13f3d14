#pragma once

#include <array>
#include <string>

#include "core/base/settings.h"
#include "core/base/tube_address.h"

namespace tubesight::board {

/// The lattice's coordinates of a point of the sheet: row and column, with fractions; columns as
/// rows of even number count them.
[[nodiscard]] std::array<double, 2> lattice_place(const core::TubesheetSettings& sheet,
                                                  const std::array<double, 2>& point_mm);

/// The address of the lattice that exists by parity and is nearest to a point of the sheet.
[[nodiscard]] core::TubeAddress nearest_address(const core::TubesheetSettings& sheet,
                                                const std::array<double, 2>& point_mm);

/// Empty where the tool may be, up to half a step beyond the last rows and columns; else what is
/// wrong with the point and what was expected.
[[nodiscard]] std::string why_off_the_sheet(const core::TubesheetSettings& sheet,
                                            const std::array<double, 2>& point_mm);

}  // namespace tubesight::board
