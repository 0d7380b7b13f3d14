#include "board/bench/simulate/lattice_geometry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/tubesheet/addresses.h"
#include "core/tubesheet/tubesheet_setup.h"
#include "drivers/settings/session_checks.h"

namespace tubesight::board {
namespace {

std::string rounded(double value) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, 5).ptr;
  return {text, end};
}

std::string place_text(const std::array<double, 2>& point_mm) {
  return "(" + rounded(point_mm[0]) + ", " + rounded(point_mm[1]) + ") mm";
}

}  // namespace

using core::TubeAddress;

std::array<double, 2> lattice_place(const core::TubesheetSettings& sheet,
                                    const std::array<double, 2>& point_mm) {
  const auto& r = sheet.row_step_mm;
  const auto& c = sheet.column_step_mm;
  const double x = point_mm[0] - sheet.origin_mm[0];
  const double y = point_mm[1] - sheet.origin_mm[1];
  const double area = r[0] * c[1] - r[1] * c[0];
  return {(x * c[1] - y * c[0]) / area, (r[0] * y - r[1] * x) / area};
}

TubeAddress nearest_address(const core::TubesheetSettings& sheet,
                            const std::array<double, 2>& point_mm) {
  const auto at = lattice_place(sheet, point_mm);
  const auto row = static_cast<std::int32_t>(std::lround(at[0]));
  TubeAddress nearest{row, static_cast<std::int32_t>(std::lround(at[1]))};
  double least = -1.0;
  // Oblique steps: the nearest is among the neighbours of the rounded place.
  for (std::int32_t r = row - 2; r <= row + 2; ++r) {
    const double shift = core::tubesheet::in_odd_row({r, 0}) ? sheet.odd_row_shift : 0.0;
    const auto column = static_cast<std::int32_t>(std::lround(at[1] - shift));
    for (std::int32_t c = column - 2; c <= column + 2; ++c) {
      if (!core::tubesheet::exists(sheet.addresses, {r, c})) {
        continue;
      }
      const auto place = core::tubesheet::center_mm(sheet, {r, c});
      const double distance = std::hypot(place[0] - point_mm[0], place[1] - point_mm[1]);
      if (least < 0.0 || distance < least) {
        least = distance;
        nearest = {r, c};
      }
    }
  }
  return nearest;
}

std::string why_off_the_sheet(const core::TubesheetSettings& sheet,
                              const std::array<double, 2>& point_mm) {
  const auto at = lattice_place(sheet, point_mm);
  constexpr double kHalfAStep = 0.5;
  const double shift = sheet.odd_row_shift;
  const bool inside = at[0] >= sheet.rows[0] - kHalfAStep && at[0] <= sheet.rows[1] + kHalfAStep &&
                      at[1] >= sheet.columns[0] + std::min(shift, 0.0) - kHalfAStep &&
                      at[1] <= sheet.columns[1] + std::max(shift, 0.0) + kHalfAStep;
  if (inside) {
    return {};
  }
  return place_text(point_mm) + " is off the sheet, at row " + rounded(at[0]) + " and column " +
         rounded(at[1]) + ", expected " + drivers::ranges_text(sheet);
}

}  // namespace tubesight::board
