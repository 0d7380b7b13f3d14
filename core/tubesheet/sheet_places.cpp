#include "core/tubesheet/sheet_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/tubesheet/addresses.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::core::tubesheet {
namespace {

// Of the steps as vectors; its magnitude is the area of a cell.
double cross_mm2(const TubesheetSettings& settings) {
  const auto& r = settings.row_step_mm;
  const auto& c = settings.column_step_mm;
  return r[0] * c[1] - r[1] * c[0];
}

}  // namespace

StepsFault check_steps(const TubesheetSettings& settings) {
  const auto [row, column] = step_lengths_mm(settings);
  constexpr double kLeastSine = 0.1;
  if (row < kShortestStep_mm || column < kShortestStep_mm) {
    return StepsFault::kShort;
  }
  return std::abs(cross_mm2(settings)) < kLeastSine * row * column ? StepsFault::kOneLine
                                                                   : StepsFault::kNone;
}

AddressFault check_address(const TubesheetSettings& settings, TubeAddress address) {
  if (!in_ranges(settings, address)) {
    return AddressFault::kOutside;
  }
  if (!exists(settings.addresses, address)) {
    return AddressFault::kNotNumbered;
  }
  const auto& missing = settings.missing;
  return std::find(missing.begin(), missing.end(), address) != missing.end()
             ? AddressFault::kMissing
             : AddressFault::kNone;
}

MoveFault check_move(const TubesheetSettings& settings, TubeAddress by) {
  if (settings.odd_row_shift != 0.0 && in_odd_row(by)) {
    return MoveFault::kRows;
  }
  const bool keeps_parity =
      settings.addresses == AddressParity::kAll || exists(AddressParity::kEvenSum, by);
  return keeps_parity ? MoveFault::kNone : MoveFault::kSum;
}

std::array<double, 2> move_mm(const TubesheetSettings& settings, TubeAddress by) {
  return {by.row * settings.row_step_mm[0] + by.column * settings.column_step_mm[0],
          by.row * settings.row_step_mm[1] + by.column * settings.column_step_mm[1]};
}

std::array<double, 2> step_lengths_mm(const TubesheetSettings& settings) {
  return {std::hypot(settings.row_step_mm[0], settings.row_step_mm[1]),
          std::hypot(settings.column_step_mm[0], settings.column_step_mm[1])};
}

void stretch(TubesheetSettings& settings, double factor) {
  for (std::size_t i = 0; i < 2; ++i) {
    settings.row_step_mm[i] *= factor;
    settings.column_step_mm[i] *= factor;
  }
}

double stretch_of(const TubesheetSettings& stretched, const TubesheetSettings& settings) {
  const auto& [x, y] = settings.row_step_mm;
  const std::size_t longer = std::abs(x) > std::abs(y) ? 0 : 1;
  return stretched.row_step_mm[longer] / settings.row_step_mm[longer];
}

std::array<double, 2> lattice_place(const TubesheetSettings& settings,
                                    const std::array<double, 2>& point_mm) {
  const auto& r = settings.row_step_mm;
  const auto& c = settings.column_step_mm;
  const double x = point_mm[0] - settings.origin_mm[0];
  const double y = point_mm[1] - settings.origin_mm[1];
  const double area = cross_mm2(settings);
  return {(x * c[1] - y * c[0]) / area, (r[0] * y - r[1] * x) / area};
}

TubeAddress nearest_address(const TubesheetSettings& settings,
                            const std::array<double, 2>& point_mm) {
  const auto at = lattice_place(settings, point_mm);
  const auto row = static_cast<std::int32_t>(std::lround(at[0]));
  TubeAddress nearest{row, static_cast<std::int32_t>(std::lround(at[1]))};
  double least = -1.0;
  // Oblique steps: the nearest is among the neighbours of the rounded place.
  for (std::int32_t r = row - 2; r <= row + 2; ++r) {
    const double shift = in_odd_row({r, 0}) ? settings.odd_row_shift : 0.0;
    const auto column = static_cast<std::int32_t>(std::lround(at[1] - shift));
    for (std::int32_t c = column - 2; c <= column + 2; ++c) {
      if (!exists(settings.addresses, {r, c})) {
        continue;
      }
      const auto place = center_mm(settings, {r, c});
      const double distance = std::hypot(place[0] - point_mm[0], place[1] - point_mm[1]);
      if (least < 0.0 || distance < least) {
        least = distance;
        nearest = {r, c};
      }
    }
  }
  return nearest;
}

bool on_the_sheet(const TubesheetSettings& settings, const std::array<double, 2>& point_mm) {
  const auto at = lattice_place(settings, point_mm);
  constexpr double kHalfAStep = 0.5;
  const double shift = settings.odd_row_shift;
  return at[0] >= settings.rows[0] - kHalfAStep && at[0] <= settings.rows[1] + kHalfAStep &&
         at[1] >= settings.columns[0] + std::min(shift, 0.0) - kHalfAStep &&
         at[1] <= settings.columns[1] + std::max(shift, 0.0) + kHalfAStep;
}

AddressBlock addresses_within(const TubesheetSettings& settings, double reach_mm,
                              const std::array<double, 2>& point_mm) {
  const auto [row_mm, column_mm] = step_lengths_mm(settings);
  // From row to row the plate is as far as the cell is high over the column step.
  const double area = std::abs(cross_mm2(settings));
  const auto rows = static_cast<std::int32_t>(reach_mm * column_mm / area);
  const auto columns =
      static_cast<std::int32_t>(reach_mm * row_mm / area + std::abs(settings.odd_row_shift));
  const TubeAddress middle = nearest_address(settings, point_mm);
  return {{std::max(settings.rows[0], middle.row - rows),
           std::min(settings.rows[1], middle.row + rows)},
          {std::max(settings.columns[0], middle.column - columns),
           std::min(settings.columns[1], middle.column + columns)}};
}

std::array<TubeAddress, 8> outermost(const TubesheetSettings& settings) {
  const auto [first, last] = settings.rows;
  const auto [left, right] = settings.columns;
  // With a shift the farthest may stand in the first or last but one row.
  const std::int32_t second = std::min(first + 1, last);
  const std::int32_t before = std::max(last - 1, first);
  return {{{first, left},
           {first, right},
           {last, left},
           {last, right},
           {second, left},
           {second, right},
           {before, left},
           {before, right}}};
}

}  // namespace tubesight::core::tubesheet
