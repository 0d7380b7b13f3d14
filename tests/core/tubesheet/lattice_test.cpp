#include "core/tubesheet/lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/tubesheet/tubesheet_setup.h"
#include "tests/support/scalars.h"

namespace tubesight::core::tubesheet {
namespace {

struct Sheet {
  const char* name;
  Vector2<double> row_step;
  Vector2<double> column_step;
  AddressParity addresses = AddressParity::kAll;
  double odd_row_shift = 0.0;
};

// Steps are multiples of 1/16 mm where it does not matter, so that every format holds them exactly.
const Sheet kSheets[] = {
    {"square", {0, 25.4}, {25.4, 0}},
    {"square, left-handed", {0, -25.375}, {25.375, 0}},
    {"square, turned", {-15, 20}, {20, 15}},
    {"triangular, oblique", {12.7, 21.997}, {25.4, 0}},
    {"triangular, obtuse", {-12.7, 21.997}, {25.4, 0}},
    {"triangular, even sums", {0, 21.997}, {12.7, 0}, AddressParity::kEvenSum},
    {"triangular, odd sums", {0, 21.997}, {12.7, 0}, AddressParity::kOddSum},
    {"triangular, odd sums, left-handed", {0, -11}, {19.0625, 0}, AddressParity::kOddSum},
    {"rectangular", {0, 17}, {31, 0}},
    {"skewed", {25, 0}, {75, 25}},
    {"skewed the other way", {3, 21}, {-40, -160}},
    {"small, even sums, skewed", {2, 6}, {9, 1}, AddressParity::kEvenSum},
    {"shifted by a quarter", {0, 25.5}, {25.5, 0}, AddressParity::kAll, 0.25},
    {"shifted back by a quarter, left-handed", {0, -22}, {25.5, 0}, AddressParity::kAll, -0.25},
    {"shifted by a half: triangular", {0, 22}, {25.375, 0}, AddressParity::kAll, 0.5},
    {"shifted by a whole step", {0, 22}, {25.375, 0}, AddressParity::kAll, 1.0},
    {"shifted, low rows", {0, 9}, {32, 0}, AddressParity::kAll, 0.375},
    {"shifted, wide rows", {1, 40}, {9, 0}, AddressParity::kAll, -0.625},
    {"shifted, skewed", {25, 3}, {75, 25}, AddressParity::kAll, 0.75},
    {"shifted, even sums", {0, 22}, {13, 0}, AddressParity::kEvenSum, 0.25},
    {"shifted, odd sums, turned", {-13, 18}, {12, 9}, AddressParity::kOddSum, -0.5},
};

template <typename S>
Lattice<S> lattice_of(const Sheet& sheet) {
  const auto settings = std::make_unique<TubesheetSettings>();
  settings->row_step_mm = {sheet.row_step.x, sheet.row_step.y};
  settings->column_step_mm = {sheet.column_step.x, sheet.column_step.y};
  settings->addresses = sheet.addresses;
  settings->odd_row_shift = sheet.odd_row_shift;
  const Result<Lattice<S>> lattice = make_lattice<S>(*settings);
  EXPECT_TRUE(lattice.has_value()) << sheet.name;
  return lattice.value_or(Lattice<S>());
}

bool exists(const Sheet& sheet, TubeAddress address) {
  const bool odd = (std::abs(address.row) + std::abs(address.column)) % 2 == 1;
  return sheet.addresses == AddressParity::kAll ||
         (sheet.addresses == AddressParity::kOddSum) == odd;
}

struct Tube {
  TubeAddress address;
  double x;
  double y;
};

// All tubes within 60 mm of the anchor and some more, by their definition alone.
std::vector<Tube> tubes_around(const Sheet& sheet, TubeAddress anchor) {
  std::vector<Tube> tubes;
  for (std::int32_t i = -60; i <= 60; ++i) {
    for (std::int32_t j = -60; j <= 60; ++j) {
      const TubeAddress address{anchor.row + i, anchor.column + j};
      const bool odd = address.row % 2 != 0;
      const bool odd_anchor = anchor.row % 2 != 0;
      const double columns = j + ((odd ? 1 : 0) - (odd_anchor ? 1 : 0)) * sheet.odd_row_shift;
      const double x = i * sheet.row_step.x + columns * sheet.column_step.x;
      const double y = i * sheet.row_step.y + columns * sheet.column_step.y;
      if (exists(sheet, address) && std::abs(x) < 120 && std::abs(y) < 120) {
        tubes.push_back({address, x, y});
      }
    }
  }
  return tubes;
}

TubeAddress anchor_of(const Sheet& sheet) {
  return sheet.addresses == AddressParity::kOddSum ? TubeAddress{40, 61} : TubeAddress{40, -62};
}

// One in a row of even number, one in a row of odd number.
std::vector<TubeAddress> anchors_of(const Sheet& sheet) {
  const TubeAddress even = anchor_of(sheet);
  return {even, {-41, even.column + 1}};
}

template <typename S>
class LatticeTest : public ::testing::Test {
 protected:
  void SetUp() override { static_cast<void>(take_overflow_flag()); }
  void TearDown() override { EXPECT_FALSE(take_overflow_flag()); }
};

using tests::Scalars;
TYPED_TEST_SUITE(LatticeTest, Scalars);

constexpr double kBound_mm = 1e-4;

TYPED_TEST(LatticeTest, PlacesAddressesByHand) {
  using S = TypeParam;
  const Lattice<S> lattice = lattice_of<S>({"", {-15, 20}, {20, 15}});
  // 3 rows and -2 columns on: (-45 - 40, 60 - 30).
  const auto offset = lattice.offset({40, 60}, {43, 58});
  EXPECT_EQ(static_cast<double>(offset.x), -85.0);
  EXPECT_EQ(static_cast<double>(offset.y), 30.0);
  const auto back = lattice.offset({43, 58}, {40, 60});
  EXPECT_EQ(static_cast<double>(back.x), 85.0);
  EXPECT_EQ(static_cast<double>(back.y), -30.0);
  const auto none = lattice.offset({-7, 8}, {-7, 8});
  EXPECT_EQ(static_cast<double>(none.x), 0.0);
}

TYPED_TEST(LatticeTest, PlacesShiftedRowsByHand) {
  using S = TypeParam;
  const Lattice<S> lattice = lattice_of<S>({"", {0, 24}, {20, 4}, AddressParity::kAll, -0.25});
  const auto expect = [&](TubeAddress from, TubeAddress to, double x, double y) {
    const auto offset = lattice.offset(from, to);
    EXPECT_EQ(static_cast<double>(offset.x), x) << from.row << " " << to.row;
    EXPECT_EQ(static_cast<double>(offset.y), y) << from.row << " " << to.row;
  };
  // The shift is (-5, -1); -7 is an odd number, too.
  expect({40, 60}, {41, 60}, -5.0, 23.0);
  expect({41, 60}, {40, 60}, 5.0, -23.0);
  expect({41, 60}, {42, 60}, 5.0, 25.0);
  expect({40, 60}, {42, 61}, 20.0, 52.0);
  expect({41, 60}, {43, 61}, 20.0, 52.0);
  expect({0, 0}, {-7, 1}, 15.0, -165.0);
  expect({-7, 1}, {1, 0}, -20.0, 188.0);
}

TYPED_TEST(LatticeTest, HalfAStepOfShiftIsTheObliqueLattice) {
  using S = TypeParam;
  const Lattice<S> shifted = lattice_of<S>({"", {0, 22}, {25.5, 0}, AddressParity::kAll, 0.5});
  const Lattice<S> oblique = lattice_of<S>({"", {12.75, 22}, {25.5, 0}});
  // Two rows on, the oblique one has come a column further.
  const auto same = [](TubeAddress address) {
    return TubeAddress{address.row, address.column - (address.row - (address.row & 1)) / 2};
  };
  for (std::int32_t row = -5; row <= 5; ++row) {
    for (std::int32_t column = -5; column <= 5; ++column) {
      const TubeAddress address{row, column};
      const TubeAddress anchor{3, -2};
      const auto offset = shifted.offset(anchor, address);
      EXPECT_EQ(offset, oblique.offset(same(anchor), same(address)));
      const Vector2<Mm<S>> point = offset + Vector2<Mm<S>>{Mm<S>(7), Mm<S>(-9)};
      EXPECT_EQ(same(shifted.nearest(anchor, point)), oblique.nearest(same(anchor), point));
    }
  }
  EXPECT_EQ(shifted.parameters().shortest_step, oblique.parameters().shortest_step);
  for (const Vector2<Mm<S>> point : {Vector2<Mm<S>>{Mm<S>(3), Mm<S>(8)}, {Mm<S>(-11), Mm<S>(2)}}) {
    const double expected = static_cast<double>(oblique.distance_to_cell_edge({0, 0}, point));
    EXPECT_NEAR(static_cast<double>(shifted.distance_to_cell_edge({0, 0}, point)), expected, 1e-5);
    EXPECT_NEAR(static_cast<double>(shifted.distance_to_cell_edge({1, 0}, point)), expected, 1e-5);
  }
}

TYPED_TEST(LatticeTest, PlacesFarAddressesOfASkewedNumbering) {
  using S = TypeParam;
  // 150 rows and -50 columns: (3750 - 3750, -1250), though each share exceeds 2048 mm.
  const Lattice<S> lattice = lattice_of<S>({"", {25, 0}, {75, 25}});
  const auto offset = lattice.offset({0, 0}, {150, -50});
  EXPECT_EQ(static_cast<double>(offset.x), 0.0);
  EXPECT_EQ(static_cast<double>(offset.y), -1250.0);
}

TYPED_TEST(LatticeTest, KnowsWhichAddressesExist) {
  using S = TypeParam;
  for (const Sheet& sheet : kSheets) {
    const Lattice<S> lattice = lattice_of<S>(sheet);
    for (std::int32_t row = -3; row <= 3; ++row) {
      for (std::int32_t column = -3; column <= 3; ++column) {
        EXPECT_EQ(lattice.has({row, column}), exists(sheet, {row, column}))
            << sheet.name << " " << row << " " << column;
      }
    }
  }
}

TYPED_TEST(LatticeTest, FindsTheShortestStep) {
  using S = TypeParam;
  const struct {
    Sheet sheet;
    double expected_mm;
  } rows[] = {{kSheets[0], 25.4},
              {kSheets[2], 25.0},
              {kSheets[3], 25.399961},  // sqrt(12.7^2 + 21.997^2)
              {kSheets[5], 25.399961},
              {{"", {0, 20}, {12.5, 0}, AddressParity::kOddSum}, 23.584953},  // sqrt(20^2 + 12.5^2)
              {{"", {0, 30}, {10, 0}, AddressParity::kEvenSum}, 20.0},        // two columns on
              {kSheets[9], 25.0},
              {{"", {0, 24}, {20, 0}, AddressParity::kAll, 0.35}, 20.0},  // within the row
              {{"", {0, 15}, {20, 0}, AddressParity::kAll, 0.4}, 17.0},   // (8, 15)
              {{"", {0, 15}, {20, 0}, AddressParity::kAll, -0.6}, 17.0},  // (-12 + 20, 15)
              {{"", {4, 15}, {20, 0}, AddressParity::kAll, 0.2}, 15.0},  // an odd row's (4 - 4, 15)
              {{"", {0, 6}, {40, 0}, AddressParity::kAll, 0.5}, 12.0},   // two rows on
              {{"", {0, 12}, {12, 0}, AddressParity::kEvenSum, 0.25}, 15.0},  // (-12 + 3, 12)
              {kSheets[10], 17.888544}};  // (-40, -160) + 8 (3, 21) = (-16, 8); (3, 21) is 21.2
  for (const auto& row : rows) {
    EXPECT_NEAR(static_cast<double>(lattice_of<S>(row.sheet).parameters().shortest_step),
                row.expected_mm, 5e-6)
        << row.sheet.name;
  }
}

TYPED_TEST(LatticeTest, NearestAgreesWithBruteForce) {
  using S = TypeParam;
  constexpr std::uint32_t kSeed = 1995;
  std::mt19937 random(kSeed);
  for (const Sheet& sheet : kSheets) {
    const Lattice<S> lattice = lattice_of<S>(sheet);
    const std::vector<TubeAddress> anchors = anchors_of(sheet);
    const std::vector<Tube> around[] = {tubes_around(sheet, anchors[0]),
                                        tubes_around(sheet, anchors[1])};
    int judged = 0;
    for (int round = 0; round < 1500; ++round) {
      const TubeAddress anchor = anchors[static_cast<std::size_t>(round % 2)];
      const std::vector<Tube>& tubes = around[round % 2];
      const double x = static_cast<double>(random() % 1920U) / 16.0 - 60.0;
      const double y = static_cast<double>(random() % 1920U) / 16.0 - 60.0;
      double best = 1e9;
      double second = 1e9;
      TubeAddress expected{};
      for (const Tube& tube : tubes) {
        const double distance = std::hypot(tube.x - x, tube.y - y);
        if (distance < best) {
          second = best;
          best = distance;
          expected = tube.address;
        } else {
          second = std::min(second, distance);
        }
      }
      if (second - best < kBound_mm) {
        continue;  // on an edge either side may win
      }
      ++judged;
      ASSERT_EQ(lattice.nearest(anchor, {Mm<S>(x), Mm<S>(y)}), expected)
          << sheet.name << ", seed " << kSeed << " round " << round << ": " << x << " " << y;
    }
    EXPECT_GT(judged, 1350) << sheet.name;
  }
}

TYPED_TEST(LatticeTest, NearestOfACentreIsItsAddressWhereverOnTheSheet) {
  using S = TypeParam;
  for (const Sheet& sheet : kSheets) {
    const Lattice<S> lattice = lattice_of<S>(sheet);
    for (const TubeAddress anchor : anchors_of(sheet)) {
      for (const TubeAddress step : {TubeAddress{8, 6}, TubeAddress{-7, 5}, TubeAddress{5, -7}}) {
        const TubeAddress address{anchor.row + step.row, anchor.column + step.column};
        EXPECT_EQ(lattice.nearest(anchor, lattice.offset(anchor, address)), address) << sheet.name;
      }
    }
  }
  const Lattice<S> square = lattice_of<S>(kSheets[0]);
  EXPECT_EQ(square.nearest({0, 0}, {Mm<S>(1485.0), Mm<S>(-1460.0)}), (TubeAddress{-57, 58}));
}

// Half of (distance to the neighbour minus the point's share along it): the perpendicular bisectors
// of all other tubes bound the cell, whichever they are.
double cell_edge_by_brute_force(const std::vector<Tube>& tubes, double x, double y) {
  double least = 1e9;
  for (const Tube& tube : tubes) {
    const double length = std::hypot(tube.x, tube.y);
    if (length > 0.0) {
      least = std::min(least, length / 2.0 - (tube.x * x + tube.y * y) / length);
    }
  }
  return least;
}

TYPED_TEST(LatticeTest, DistanceToTheCellEdgeAgreesWithBruteForce) {
  using S = TypeParam;
  constexpr std::uint32_t kSeed = 42;
  std::mt19937 random(kSeed);
  for (const Sheet& sheet : kSheets) {
    const Lattice<S> lattice = lattice_of<S>(sheet);
    const std::vector<TubeAddress> anchors = anchors_of(sheet);
    const std::vector<Tube> around[] = {tubes_around(sheet, anchors[0]),
                                        tubes_around(sheet, anchors[1])};
    int inside = 0;
    for (int round = 0; round < 1000; ++round) {
      const TubeAddress tube = anchors[static_cast<std::size_t>(round % 2)];
      const std::vector<Tube>& tubes = around[round % 2];
      const double x = static_cast<double>(random() % 512U) / 16.0 - 16.0;
      const double y = static_cast<double>(random() % 512U) / 16.0 - 16.0;
      const double expected = cell_edge_by_brute_force(tubes, x, y);
      const double actual =
          static_cast<double>(lattice.distance_to_cell_edge(tube, {Mm<S>(x), Mm<S>(y)}));
      if (expected >= 0.0) {
        ++inside;
        ASSERT_NEAR(actual, expected, 1e-5)
            << sheet.name << ", seed " << kSeed << " round " << round << ": " << x << " " << y;
      } else {
        ASSERT_LT(actual, 1e-5) << sheet.name << ": " << x << " " << y;
      }
    }
    EXPECT_GT(inside, 20) << sheet.name;
  }
}

TYPED_TEST(LatticeTest, DistanceToTheCellEdgeByHand) {
  using S = TypeParam;
  const Lattice<S> lattice = lattice_of<S>({"", {0, 24}, {24, 0}});
  EXPECT_NEAR(static_cast<double>(lattice.distance_to_cell_edge({0, 0}, {Mm<S>(0), Mm<S>(0)})), 12,
              1e-5);
  EXPECT_NEAR(static_cast<double>(lattice.distance_to_cell_edge({0, 0}, {Mm<S>(5), Mm<S>(-9)})), 3,
              1e-5);
  EXPECT_NEAR(static_cast<double>(lattice.distance_to_cell_edge({0, 0}, {Mm<S>(-13), Mm<S>(0)})),
              -1, 1e-5);
}

TYPED_TEST(LatticeTest, CellsOfShiftedRowsAreLopsided) {
  using S = TypeParam;
  const Lattice<S> lattice = lattice_of<S>({"", {0, 24}, {24, 0}, AddressParity::kAll, 0.25});
  const auto to_edge = [&](TubeAddress tube, double x, double y) {
    return static_cast<double>(lattice.distance_to_cell_edge(tube, {Mm<S>(x), Mm<S>(y)}));
  };
  // Row 1 stands 6 mm further: (6, 24) and (-18, 24) bound row 0's tubes above and below alike.
  const double length = std::hypot(6.0, 24.0);
  EXPECT_NEAR(to_edge({0, 0}, 6.0, 10.0), length / 2.0 - (36.0 + 240.0) / length, 1e-5);
  EXPECT_NEAR(to_edge({0, 0}, -6.0, 10.0), 15.0 - (6.0 * 18.0 + 240.0) / 30.0, 1e-5);
  EXPECT_NEAR(to_edge({0, 0}, 6.0, -10.0), length / 2.0 - (36.0 + 240.0) / length, 1e-5);
  // And row 0 stands 6 mm behind row 1.
  EXPECT_NEAR(to_edge({1, 0}, -6.0, 10.0), length / 2.0 - (36.0 + 240.0) / length, 1e-5);
  EXPECT_NEAR(to_edge({-3, 0}, 6.0, 10.0), 15.0 - (6.0 * 18.0 + 240.0) / 30.0, 1e-5);
}

template <typename S>
void expect_refused(Vector2<double> row_step, Vector2<double> column_step, AddressParity addresses,
                    Error expected) {
  const auto settings = std::make_unique<TubesheetSettings>();
  settings->row_step_mm = {row_step.x, row_step.y};
  settings->column_step_mm = {column_step.x, column_step.y};
  settings->addresses = addresses;
  const Result<Lattice<S>> lattice = make_lattice<S>(*settings);
  ASSERT_FALSE(lattice.has_value()) << row_step.x << " " << row_step.y;
  EXPECT_EQ(lattice.error(), expected) << row_step.x << " " << row_step.y;
}

TYPED_TEST(LatticeTest, RefusesBadSteps) {
  using S = TypeParam;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr AddressParity kAll = AddressParity::kAll;
  constexpr AddressParity kEven = AddressParity::kEvenSum;
  expect_refused<S>({10, 20}, {20, 40}, kAll, Error::kIllConditioned);
  expect_refused<S>({25, 0}, {-25, 2}, kAll, Error::kIllConditioned);  // 4.6 degrees
  expect_refused<S>({0, 0}, {25, 0}, kAll, Error::kOutOfRange);
  expect_refused<S>({0, 1.9}, {25, 0}, kAll, Error::kOutOfRange);
  expect_refused<S>({0, 1e-12}, {500, 1}, kAll, Error::kOutOfRange);
  expect_refused<S>({0, 501}, {25, 0}, kAll, Error::kOutOfRange);
  expect_refused<S>({0, 25}, {1e200, 0}, kAll, Error::kOutOfRange);
  expect_refused<S>({0, kNan}, {25, 0}, kAll, Error::kOutOfRange);
  expect_refused<S>({0, 25}, {kInfinity, 0}, kAll, Error::kOutOfRange);
  expect_refused<S>({0, 1.2}, {1.2, 0}, kEven, Error::kOutOfRange);  // diagonal 1.70 mm
}

TYPED_TEST(LatticeTest, TakesStepsAtTheLimits) {
  using S = TypeParam;
  const Sheet sheets[] = {{"2 mm", {0, 2}, {2, 0}},
                          {"500 mm", {0, 500}, {500, 0}},
                          {"5.3 degrees", {25, 0}, {-250, 23}},
                          {"500 mm, shifted", {0, 500}, {500, 0}, AddressParity::kAll, 0.3},
                          {"diagonal 2.12 mm", {0, 1.5}, {1.5, 0}, AddressParity::kEvenSum}};
  for (const Sheet& sheet : sheets) {
    const Lattice<S> lattice = lattice_of<S>(sheet);
    EXPECT_GT(static_cast<double>(lattice.parameters().shortest_step), 1.999) << sheet.name;
  }
}

}  // namespace
}  // namespace tubesight::core::tubesheet
