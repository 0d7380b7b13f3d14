#include "board/visionbox/page_lattice.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

core::TubesheetSettings square() {
  core::TubesheetSettings sheet;
  sheet.row_step_mm = {0.0, 25.4};
  sheet.column_step_mm = {25.4, 0.0};
  return sheet;
}

bool has(const std::vector<LatticeWay>& ways, const LatticeWay& way) {
  return std::find(ways.begin(), ways.end(), way) != ways.end();
}

TEST(LatticeWays, OfASquareSheetAreFourTurnsOfOneHandedness) {
  // i to the right and j down as the sheet's x and y: columns grow with i, rows with j.
  const auto ways = lattice_ways(square(), {1.0, 0.0}, {0.0, 1.0});
  EXPECT_EQ(ways.size(), 4U);
  EXPECT_TRUE(has(ways, {0, 1, 1, 0}));
  EXPECT_TRUE(has(ways, {0, -1, -1, 0}));
  EXPECT_FALSE(has(ways, {1, 0, 0, 1}));  // the mirror image
}

TEST(LatticeWays, StandForALatticeThatIsTurnedAndALittleAskew) {
  EXPECT_EQ(lattice_ways(square(), {7.0, 7.3}, {-7.1, 6.8}).size(), 4U);
}

TEST(LatticeWays, AreNoneWhereTheLatticeIsAnother) {
  EXPECT_TRUE(lattice_ways(square(), {1.0, 0.0}, {0.5, 0.866}).empty());
  EXPECT_TRUE(lattice_ways(square(), {1.0, 0.0}, {0.0, 2.0}).empty());
}

TEST(LatticeWays, OfATriangularSheetAreSixTurns) {
  core::TubesheetSettings sheet;
  sheet.row_step_mm = {12.7, 21.997};
  sheet.column_step_mm = {25.4, 0.0};
  EXPECT_EQ(lattice_ways(sheet, {1.0, 0.0}, {0.5, 0.866}).size(), 6U);
}

TEST(LatticeWays, OfANumberingThatLeavesOutEveryOtherAddressKeepToThoseThatThereAre) {
  core::TubesheetSettings sheet = square();
  sheet.addresses = core::AddressParity::kEvenSum;
  const auto ways = lattice_ways(sheet, {1.0, 1.0}, {-1.0, 1.0});
  EXPECT_EQ(ways.size(), 4U);
  for (const LatticeWay& way : ways) {
    EXPECT_EQ((way.a + way.c) % 2, 0);
    EXPECT_EQ((way.b + way.d) % 2, 0);
  }
}

TEST(LatticeWays, AreNotToldWhereRowsAreShifted) {
  core::TubesheetSettings sheet = square();
  sheet.odd_row_shift = 0.5;
  EXPECT_TRUE(lattice_ways(sheet, {1.0, 0.0}, {0.0, 1.0}).empty());
}

}  // namespace
}  // namespace tubesight::board
