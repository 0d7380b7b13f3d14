#include "board/bench/simulate/lattice_geometry.h"

#include <gtest/gtest.h>

#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::board {
namespace {

core::TubesheetSettings oblique() {
  core::TubesheetSettings sheet;
  sheet.origin_mm = {5.0, -7.0};
  sheet.row_step_mm = {10.0, 20.0};
  sheet.column_step_mm = {22.0, 0.0};
  sheet.rows = {0, 100};
  sheet.columns = {0, 100};
  return sheet;
}

TEST(LatticePlace, IsTheInverseOfTheCentre) {
  const auto sheet = oblique();

  // Row 3, column 4: (5 + 30 + 88, -7 + 60).
  EXPECT_EQ(core::tubesheet::center_mm(sheet, {3, 4}), (std::array<double, 2>{123.0, 53.0}));
  const auto at = lattice_place(sheet, {123.0, 53.0});
  EXPECT_NEAR(at[0], 3.0, 1e-12);
  EXPECT_NEAR(at[1], 4.0, 1e-12);
}

TEST(NearestAddress, LooksBeyondTheRoundedPlaceAndSkipsAbsentAddresses) {
  auto sheet = oblique();

  // Between (3, 4) at (123, 53) and (4, 4) at (133, 73), nearer to (4, 4) though 3.49 rounds to 3.
  EXPECT_EQ(nearest_address(sheet, {131.0, 72.0}), (core::TubeAddress{4, 4}));
  EXPECT_EQ(nearest_address(sheet, {125.0, 53.0}), (core::TubeAddress{3, 4}));
  sheet.addresses = core::AddressParity::kEvenSum;
  EXPECT_EQ(
      (nearest_address(sheet, {125.0, 53.0}).row + nearest_address(sheet, {125.0, 53.0}).column) %
          2,
      0);
}

TEST(NearestAddress, KnowsShiftedRows) {
  auto sheet = oblique();
  sheet.row_step_mm = {0.0, 20.0};
  sheet.odd_row_shift = 0.75;

  // Row 3, column 4 stands at (5 + 88 + 16.5, -7 + 60), row 4 not shifted at (93, 73).
  EXPECT_EQ(core::tubesheet::center_mm(sheet, {3, 4}), (std::array<double, 2>{109.5, 53.0}));
  EXPECT_EQ(core::tubesheet::center_mm(sheet, {4, 4}), (std::array<double, 2>{93.0, 73.0}));
  EXPECT_EQ(nearest_address(sheet, {99.0, 52.0}), (core::TubeAddress{3, 4}));
  EXPECT_EQ(nearest_address(sheet, {98.0, 52.0}), (core::TubeAddress{3, 3}));
  EXPECT_EQ(nearest_address(sheet, {98.0, 72.0}), (core::TubeAddress{4, 4}));
}

TEST(WhyOffTheSheet, CountsShiftedRowsIn) {
  auto sheet = oblique();
  sheet.row_step_mm = {0.0, 20.0};
  sheet.odd_row_shift = -0.5;

  // Row 3, column 0 stands at (-6, 53), with half a step more to its left; row 3 ends at column
  // 100, (2194, 53), though even rows reach to 2205.
  EXPECT_EQ(why_off_the_sheet(sheet, {-16.9, 53.0}), "");
  EXPECT_NE(why_off_the_sheet(sheet, {-17.1, 53.0}), "");
  EXPECT_EQ(why_off_the_sheet(sheet, {2215.9, 53.0}), "");
  EXPECT_NE(why_off_the_sheet(sheet, {2216.1, 53.0}), "");
}

}  // namespace
}  // namespace tubesight::board
