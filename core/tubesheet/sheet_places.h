#pragma once

#include <array>
#include <cstdint>

#include "core/base/settings.h"
#include "core/base/tube_address.h"

namespace tubesight::core::tubesheet {

// Addresses and places of a tubesheet's settings, in double precision: for readers of settings, for
// simulation and for what happens at rest. Whoever words a refusal does so from the enums here, so
// that no other folder knows which addresses there are. The steps are those that check_steps()
// takes, but where it is said.

/// Why two steps span no lattice.
enum class StepsFault : std::uint8_t {
  kNone,
  kShort,    ///< a step below kShortestStep_mm
  kOneLine,  ///< less than 6 degrees apart
};
inline constexpr double kShortestStep_mm = 1.0;
/// Longer ones leave the numbers of the tracking path; make_lattice() refuses them.
inline constexpr double kLongestStep_mm = 500.0;
/// Of a column step, to either side.
inline constexpr double kLargestShift = 1.0;

/// Whether any steps span a lattice.
[[nodiscard]] StepsFault check_steps(const TubesheetSettings& settings);

/// Why no tube stands at an address.
enum class AddressFault : std::uint8_t {
  kNone,
  kOutside,      ///< of the sheet's first and last row and column
  kNotNumbered,  ///< the numbering leaves it out
  kMissing,      ///< listed as missing
};

/// Whether an address is within the first and last row and column.
[[nodiscard]] constexpr bool in_ranges(const TubesheetSettings& settings, TubeAddress address) {
  return address.row >= settings.rows[0] && address.row <= settings.rows[1] &&
         address.column >= settings.columns[0] && address.column <= settings.columns[1];
}

/// Whether a tube stands at an address. Any steps.
[[nodiscard]] AddressFault check_address(const TubesheetSettings& settings, TubeAddress address);

/// Why a sheet moved by rows and columns does not lie on itself.
enum class MoveFault : std::uint8_t {
  kNone,
  kRows,  ///< the number of rows, as every other row is shifted
  kSum,   ///< the sum of rows and columns, as every other address is left out
};

/// Whether the lattice, moved by these rows and columns, lies on itself. Any steps.
[[nodiscard]] MoveFault check_move(const TubesheetSettings& settings, TubeAddress by);

/// Where rows and columns lead that check_move() takes, mm.
[[nodiscard]] std::array<double, 2> move_mm(const TubesheetSettings& settings, TubeAddress by);

/// The lengths of the row step and the column step as they are given, mm.
[[nodiscard]] std::array<double, 2> step_lengths_mm(const TubesheetSettings& settings);

/// Makes both steps longer by a factor.
void stretch(TubesheetSettings& settings, double factor);

/// By which factor the steps of `stretched` are longer than those of `settings`.
[[nodiscard]] double stretch_of(const TubesheetSettings& stretched,
                                const TubesheetSettings& settings);

/// The lattice's coordinates of a point of the sheet: row and column, with fractions; columns as
/// rows of even number count them.
[[nodiscard]] std::array<double, 2> lattice_place(const TubesheetSettings& settings,
                                                  const std::array<double, 2>& point_mm);

/// The address that the numbering has and that is nearest to a point of the sheet.
[[nodiscard]] TubeAddress nearest_address(const TubesheetSettings& settings,
                                          const std::array<double, 2>& point_mm);

/// Whether a point is on the sheet, up to half a step beyond the last rows and columns.
[[nodiscard]] bool on_the_sheet(const TubesheetSettings& settings,
                                const std::array<double, 2>& point_mm);

/// Rows and columns, first and last; nothing where the first is above the last.
struct AddressBlock {
  std::array<std::int32_t, 2> rows{};
  std::array<std::int32_t, 2> columns{};
};

/// A block of the sheet with all tubes within a distance of a point.
[[nodiscard]] AddressBlock addresses_within(const TubesheetSettings& settings, double reach_mm,
                                            const std::array<double, 2>& point_mm);

/// Those of an address between which the farthest tubes of the sheet are, whatever the shift.
[[nodiscard]] std::array<TubeAddress, 8> outermost(const TubesheetSettings& settings);

}  // namespace tubesight::core::tubesheet
