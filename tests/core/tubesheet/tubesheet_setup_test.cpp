#include "core/tubesheet/tubesheet_setup.h"

#include <array>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

namespace tubesight::core::tubesheet {
namespace {

TEST(CenterOfATube, StandsFurtherInOddRows) {
  const auto sheet = std::make_unique<TubesheetSettings>();
  sheet->origin_mm = {5.0, -7.0};
  sheet->row_step_mm = {1.0, 20.0};
  sheet->column_step_mm = {24.0, 4.0};
  EXPECT_EQ(center_mm(*sheet, {-3, 2}), (std::array<double, 2>{50.0, -59.0}));
  sheet->odd_row_shift = -0.25;
  EXPECT_EQ(center_mm(*sheet, {-3, 2}), (std::array<double, 2>{44.0, -60.0}));
  EXPECT_EQ(center_mm(*sheet, {-2, 2}), (std::array<double, 2>{51.0, -39.0}));
}

TEST(MakeLattice, RefusesABadShift) {
  const auto settings = std::make_unique<TubesheetSettings>();
  settings->row_step_mm = {0, 2.4};
  settings->column_step_mm = {25, 0};
  for (const double shift : {1.01, -1.01, std::numeric_limits<double>::quiet_NaN()}) {
    settings->odd_row_shift = shift;
    EXPECT_FALSE(make_lattice<FixedPoint>(*settings).has_value()) << shift;
  }
  settings->odd_row_shift = 0.5;
  EXPECT_TRUE(make_lattice<FixedPoint>(*settings).has_value());
  // Row 1 would stand straight above row 0, 1.8 mm off.
  settings->row_step_mm = {0.3, 1.8};
  settings->odd_row_shift = -0.012;
  EXPECT_EQ(make_lattice<FixedPoint>(*settings).error(), Error::kOutOfRange);
}

TEST(ShortestStep, IsTheDistanceOfTheNearestTwoTubes) {
  const auto sheet = std::make_unique<TubesheetSettings>();
  sheet->row_step_mm = {0.0, 25.4};
  sheet->column_step_mm = {25.4, 0.0};
  EXPECT_DOUBLE_EQ(shortest_step_mm(*sheet), 25.4);
  // (100, 30) and (110, 30) differ by (10, 0): far shorter than both.
  sheet->row_step_mm = {100.0, 30.0};
  sheet->column_step_mm = {110.0, 30.0};
  EXPECT_NEAR(shortest_step_mm(*sheet), 10.0, 1e-9);
  // Triangular pitch 22 mm as a rectangle, rows of half the pitch's height: sqrt(11^2 + 19.05^2).
  sheet->row_step_mm = {0.0, 19.05};
  sheet->column_step_mm = {11.0, 0.0};
  sheet->addresses = AddressParity::kOddSum;
  EXPECT_NEAR(shortest_step_mm(*sheet), 21.998, 0.001);
  // The same by a shift of half a step.
  sheet->addresses = AddressParity::kAll;
  sheet->column_step_mm = {22.0, 0.0};
  sheet->odd_row_shift = 0.5;
  EXPECT_NEAR(shortest_step_mm(*sheet), 21.998, 0.001);
}

}  // namespace
}  // namespace tubesight::core::tubesheet
