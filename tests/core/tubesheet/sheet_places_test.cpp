#include "core/tubesheet/sheet_places.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "core/tubesheet/addresses.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::core::tubesheet {
namespace {

std::unique_ptr<TubesheetSettings> oblique() {
  auto sheet = std::make_unique<TubesheetSettings>();
  sheet->origin_mm = {5.0, -7.0};
  sheet->row_step_mm = {10.0, 20.0};
  sheet->column_step_mm = {22.0, 0.0};
  sheet->rows = {0, 100};
  sheet->columns = {0, 100};
  return sheet;
}

TEST(LatticePlace, IsTheInverseOfTheCentre) {
  const auto sheet = oblique();

  // Row 3, column 4: (5 + 30 + 88, -7 + 60).
  EXPECT_EQ(center_mm(*sheet, {3, 4}), (std::array<double, 2>{123.0, 53.0}));
  const auto at = lattice_place(*sheet, {123.0, 53.0});
  EXPECT_NEAR(at[0], 3.0, 1e-12);
  EXPECT_NEAR(at[1], 4.0, 1e-12);
}

TEST(NearestAddress, LooksBeyondTheRoundedPlaceAndSkipsAbsentAddresses) {
  const auto sheet = oblique();

  // Between (3, 4) at (123, 53) and (4, 4) at (133, 73), nearer to (4, 4) though 3.49 rounds to 3.
  EXPECT_EQ(nearest_address(*sheet, {131.0, 72.0}), (TubeAddress{4, 4}));
  EXPECT_EQ(nearest_address(*sheet, {125.0, 53.0}), (TubeAddress{3, 4}));
  sheet->addresses = AddressParity::kEvenSum;
  EXPECT_EQ(
      (nearest_address(*sheet, {125.0, 53.0}).row + nearest_address(*sheet, {125.0, 53.0}).column) %
          2,
      0);
}

TEST(NearestAddress, KnowsShiftedRows) {
  const auto sheet = oblique();
  sheet->row_step_mm = {0.0, 20.0};
  sheet->odd_row_shift = 0.75;

  // Row 3, column 4 stands at (5 + 88 + 16.5, -7 + 60), row 4 not shifted at (93, 73).
  EXPECT_EQ(center_mm(*sheet, {3, 4}), (std::array<double, 2>{109.5, 53.0}));
  EXPECT_EQ(center_mm(*sheet, {4, 4}), (std::array<double, 2>{93.0, 73.0}));
  EXPECT_EQ(nearest_address(*sheet, {99.0, 52.0}), (TubeAddress{3, 4}));
  EXPECT_EQ(nearest_address(*sheet, {98.0, 52.0}), (TubeAddress{3, 3}));
  EXPECT_EQ(nearest_address(*sheet, {98.0, 72.0}), (TubeAddress{4, 4}));
}

TEST(OnTheSheet, CountsShiftedRowsIn) {
  const auto sheet = oblique();
  sheet->row_step_mm = {0.0, 20.0};
  sheet->odd_row_shift = -0.5;

  // Row 3, column 0 stands at (-6, 53), with half a step more to its left; row 3 ends at column
  // 100, (2194, 53), though even rows reach to 2205.
  EXPECT_TRUE(on_the_sheet(*sheet, {-16.9, 53.0}));
  EXPECT_FALSE(on_the_sheet(*sheet, {-17.1, 53.0}));
  EXPECT_TRUE(on_the_sheet(*sheet, {2215.9, 53.0}));
  EXPECT_FALSE(on_the_sheet(*sheet, {2216.1, 53.0}));
}

TEST(CheckAddress, TellsWhatKeepsATubeAway) {
  const auto sheet = oblique();
  sheet->addresses = AddressParity::kOddSum;
  ASSERT_TRUE(sheet->missing.try_push_back({3, 4}));

  EXPECT_EQ(check_address(*sheet, {2, 3}), AddressFault::kNone);
  EXPECT_EQ(check_address(*sheet, {2, 4}), AddressFault::kNotNumbered);
  EXPECT_EQ(check_address(*sheet, {3, 4}), AddressFault::kMissing);
  EXPECT_EQ(check_address(*sheet, {101, 4}), AddressFault::kOutside);
  EXPECT_EQ(check_address(*sheet, {0, -1}), AddressFault::kOutside);
}

TEST(CheckSteps, RefusesShortStepsAndStepsInOneLine) {
  const auto sheet = oblique();
  EXPECT_EQ(check_steps(*sheet), StepsFault::kNone);
  sheet->row_step_mm = {0.0, 0.9};
  EXPECT_EQ(check_steps(*sheet), StepsFault::kShort);
  sheet->row_step_mm = {20.0, 1.9};  // 5.4 degrees
  EXPECT_EQ(check_steps(*sheet), StepsFault::kOneLine);
}

TEST(CheckMove, NeedsAnEvenSumOrAnEvenNumberOfRows) {
  const auto sheet = oblique();
  EXPECT_EQ(check_move(*sheet, {1, 2}), MoveFault::kNone);
  sheet->odd_row_shift = 0.25;
  EXPECT_EQ(check_move(*sheet, {-2, 3}), MoveFault::kNone);
  EXPECT_EQ(check_move(*sheet, {-1, 3}), MoveFault::kRows);
  sheet->addresses = AddressParity::kOddSum;
  EXPECT_EQ(check_move(*sheet, {-2, 4}), MoveFault::kNone);
  EXPECT_EQ(check_move(*sheet, {-2, 3}), MoveFault::kSum);
  EXPECT_EQ(check_move(*sheet, {-1, 3}), MoveFault::kRows);
  sheet->odd_row_shift = 0.0;
  EXPECT_EQ(check_move(*sheet, {-1, 3}), MoveFault::kNone);
}

TEST(Stretch, MakesBothStepsLongerAndIsFoundAgain) {
  const auto sheet = oblique();
  const auto longer = oblique();
  stretch(*longer, 1.25);
  EXPECT_EQ(longer->row_step_mm, (std::array<double, 2>{12.5, 25.0}));
  EXPECT_EQ(longer->column_step_mm, (std::array<double, 2>{27.5, 0.0}));
  EXPECT_EQ(stretch_of(*longer, *sheet), 1.25);
}

TEST(SpanningSteps, LeadFromAddressesOfTheNumberingToOthers) {
  for (const auto addresses :
       {AddressParity::kAll, AddressParity::kEvenSum, AddressParity::kOddSum}) {
    const auto steps = spanning_steps(addresses);
    const TubeAddress from{4, addresses == AddressParity::kOddSum ? 7 : 6};
    for (const TubeAddress step : steps) {
      EXPECT_TRUE(exists(addresses, sum(from, step)));
      EXPECT_TRUE(exists(addresses, difference(from, step)));
    }
    // They span a cell as large as the numbering is thin.
    EXPECT_EQ(std::abs(steps[0].row * steps[1].column - steps[0].column * steps[1].row),
              addresses == AddressParity::kAll ? 1 : 2);
  }
}

TEST(MoveMm, IsTheWayBetweenTubesOfAKind) {
  const auto sheet = oblique();
  sheet->odd_row_shift = 0.75;

  // Rows 3 and 5 are shifted alike: 2 (10, 20) - (22, 0).
  EXPECT_EQ(move_mm(*sheet, {2, -1}), (std::array<double, 2>{-2.0, 40.0}));
}

TEST(AddressesWithin, HoldsEveryTubeThatNearAndNoneOffTheSheet) {
  const auto sheet = oblique();
  sheet->odd_row_shift = 0.75;
  const std::array<double, 2> point{120.0, 150.0};
  const AddressBlock block = addresses_within(*sheet, 90.0, point);

  for (std::int32_t row = 0; row <= 100; ++row) {
    for (std::int32_t column = 0; column <= 100; ++column) {
      const auto at = center_mm(*sheet, {row, column});
      if (std::hypot(at[0] - point[0], at[1] - point[1]) < 85.0) {
        EXPECT_TRUE(row >= block.rows[0] && row <= block.rows[1]) << row;
        EXPECT_TRUE(column >= block.columns[0] && column <= block.columns[1]) << column;
      }
    }
  }
  EXPECT_GE(block.columns[0], 0);
  EXPECT_LT(block.rows[1], 15);
}

TEST(Outermost, HasTheFarthestTubeOfAShiftedRow) {
  const auto sheet = oblique();
  sheet->odd_row_shift = 1.0;
  double farthest = 0.0;
  for (const TubeAddress address : outermost(*sheet)) {
    farthest = std::max(farthest, center_mm(*sheet, address)[0]);
  }

  // Row 99, column 100: 5 + 990 + 101 x 22; row 100 is not shifted and ends at 5 + 1000 + 2200.
  EXPECT_EQ(farthest, 3217.0);
}

}  // namespace
}  // namespace tubesight::core::tubesheet
