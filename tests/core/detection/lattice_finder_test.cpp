// Lattices drawn in all the ways that a picture may show one, found without being told anything.

#include "core/detection/lattice_finder.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/detection/drawn_lattice.h"
#include "tests/support/heap_guard.h"

namespace tubesight::core::detection {
namespace {

/// What was found, held against what was drawn.
struct Comparison {
  int found = 0;      ///< drawn elements that an element found stands on
  int surplus = 0;    ///< elements found where none was drawn
  int misplaced = 0;  ///< out of order: not where one map of indices to indices says
  double worst_px = 0.0;
};

class LatticeFinderOn : public ::testing::Test {
 protected:
  FinderRefusal find(const picture::AveragedPicture& picture) {
    scratch_.resize(drawn_.pixels.size());
    return finder_->find(picture, {}, scratch_, *found_);
  }

  /// Pairs by place, then checks that drawn (row, column) follow from those found by one map of
  /// determinant 1: not mirrored, no index left out.
  Comparison compare() {
    Comparison result;
    std::vector<Eigen::Vector3d> from;
    std::vector<Eigen::Vector2d> to;
    for (const LatticeElement& element : found_->elements) {
      double best = 3.0;
      Eigen::Vector2d index;
      for (int row = 0; row < drawn_.rows; ++row) {
        for (int column = 0; column < drawn_.columns; ++column) {
          const double off =
              (drawn_.pixel_of(drawn_.center(row, column)) - element.center_px).norm();
          if (off < best) {
            best = off;
            index << row, column;
          }
        }
      }
      if (best >= 3.0) {
        ++result.surplus;
        continue;
      }
      ++result.found;
      result.worst_px = std::max(result.worst_px, best);
      from.emplace_back(element.row, element.column, 1.0);
      to.push_back(index);
    }
    if (from.size() < 3) {
      return result;
    }
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 2, 3> mixed = Eigen::Matrix<double, 2, 3>::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
      square += from[i] * from[i].transpose();
      mixed += to[i] * from[i].transpose();
    }
    const Eigen::Matrix<double, 2, 3> map = mixed * square.inverse();
    EXPECT_NEAR(map.leftCols<2>().determinant(), 1.0, 1e-6);
    for (std::size_t i = 0; i < from.size(); ++i) {
      result.misplaced += (map * from[i] - to[i]).norm() > 1e-6 ? 1 : 0;
    }
    return result;
  }

  void expect_all(double within_px) {
    const Comparison result = compare();
    EXPECT_EQ(result.found, drawn_.rows * drawn_.columns);
    EXPECT_EQ(result.surplus, 0);
    EXPECT_EQ(result.misplaced, 0);
    EXPECT_LT(result.worst_px, within_px);
  }

  DrawnLattice drawn_;
  std::unique_ptr<LatticeFinder> finder_ = std::make_unique<LatticeFinder>();
  std::unique_ptr<FoundLattice> found_ = std::make_unique<FoundLattice>();
  std::vector<std::uint16_t> scratch_;
};

TEST_F(LatticeFinderOn, ASquareSheetFindsEveryDot) {
  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  EXPECT_TRUE(found_->dark);
  expect_all(0.03);
  // In radii, of which an edge drawn without blur is measured a tenth of a pixel off.
  EXPECT_NEAR(found_->steps.column.norm(), 4.0, 0.035);
  EXPECT_NEAR(found_->steps.row.norm(), 4.0, 0.035);
  EXPECT_EQ(found_->elements[0].row, 0);
  EXPECT_EQ(found_->elements[0].column, 0);
}

TEST_F(LatticeFinderOn, BrightDotsOnDarkFindsThemBright) {
  drawn_.background = 12.0;
  drawn_.inside = 170.0;
  drawn_.noise = 1.5;

  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  EXPECT_FALSE(found_->dark);
  expect_all(0.06);
}

TEST_F(LatticeFinderOn, TriangularAndTightFindsEveryDot) {
  drawn_.column = {1.2, 0.0};
  drawn_.row = {0.6, 1.0392};
  drawn_.rows = 13;
  drawn_.columns = 13;
  drawn_.turn_deg = 17.0;

  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  expect_all(0.25);
  EXPECT_NEAR(found_->steps.column.norm(), 2.4, 0.05);
  EXPECT_NEAR(found_->steps.row.norm(), 2.4, 0.05);
}

TEST_F(LatticeFinderOn, AnObliqueLatticeFindsEveryDot) {
  drawn_.column = {2.2, 0.3};
  drawn_.row = {0.7, 1.5};

  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  expect_all(0.2);
}

TEST_F(LatticeFinderOn, ASheetAslantBySixtyDegreesFindsEveryDot) {
  for (const double turn : {0.0, 20.0, 45.0}) {
    drawn_.tilt_deg = 60.0;
    drawn_.turn_deg = turn;
    drawn_.distance = 22.0;
    drawn_.rows = 7;
    drawn_.columns = 7;

    ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone) << turn;

    expect_all(0.3);
  }
}

TEST_F(LatticeFinderOn, AWideAnglesCurvedRowsFindsEveryDot) {
  drawn_.focal_px = 380.0;
  drawn_.distortion = 0.25;
  drawn_.tilt_deg = 25.0;
  drawn_.turn_deg = -8.0;
  drawn_.distance = 14.5;
  drawn_.rows = 8;
  drawn_.columns = 8;

  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  expect_all(0.5);  // no camera model: the lens bends what neighbours let expect
}

TEST_F(LatticeFinderOn, DotsOfEightPixelsFindsThem) {
  drawn_.distance = 62.0;
  drawn_.rows = 20;
  drawn_.columns = 20;
  drawn_.noise = 2.0;

  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  expect_all(0.2);
}

TEST_F(LatticeFinderOn, ElementsOfTwoHundredPixelsFindsThem) {
  drawn_.width_px = 1280;
  drawn_.height_px = 960;
  drawn_.distance = 2.5;
  drawn_.column = {1.45, 0.0};
  drawn_.row = {0.0, 1.45};
  drawn_.rows = 3;
  drawn_.columns = 4;

  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  expect_all(0.05);
}

TEST_F(LatticeFinderOn, AShadowAcrossThePictureFindsEveryDot) {
  drawn_.shadow = 0.85;
  drawn_.noise = 1.0;

  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  expect_all(0.1);
}

TEST_F(LatticeFinderOn, LittleLightBehindAVeilFindsEveryDot) {
  // At the right edge a dot's inside has two thirds of the level of what is around it.
  drawn_.shadow = 0.95;
  drawn_.veil = 14.0;
  drawn_.noise = 0.8;

  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  expect_all(1.0);
}

TEST_F(LatticeFinderOn, WhatIsHiddenInPartIsFoundAndWhatIsHiddenWhollyIsNot) {
  const picture::AveragedPicture picture = drawn_.draw();
  const Eigen::Vector2d whole = drawn_.pixel_of(drawn_.center(3, 4));
  const int u = static_cast<int>(whole.x());
  const int v = static_cast<int>(whole.y());
  // From above: wholly over (3, 4), over a third of (4, 4)'s diameter of 25 px.
  drawn_.cover(u - 18, v - 18, u + 18, v + 46, 25);

  ASSERT_EQ(find(picture), FinderRefusal::kNone);

  const Comparison result = compare();
  EXPECT_EQ(result.surplus, 0);
  EXPECT_EQ(result.misplaced, 0);
  EXPECT_EQ(result.found, drawn_.rows * drawn_.columns - 1);
}

TEST_F(LatticeFinderOn, ALatticeCutOffByThePictureFindsWhatIsInIt) {
  drawn_.rows = 20;
  drawn_.columns = 20;
  drawn_.shift = {0.3, 0.2};

  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  const Comparison result = compare();
  int whole = 0;
  for (int row = 0; row < drawn_.rows; ++row) {
    for (int column = 0; column < drawn_.columns; ++column) {
      const Eigen::Vector2d at = drawn_.pixel_of(drawn_.center(row, column));
      whole += at.x() > 15.0 && at.y() > 15.0 && at.x() < 624.0 && at.y() < 464.0 ? 1 : 0;
    }
  }
  EXPECT_GE(result.found, whole);
  EXPECT_EQ(result.surplus, 0);
  EXPECT_EQ(result.misplaced, 0);
  EXPECT_LT(result.worst_px, 0.5);
}

TEST_F(LatticeFinderOn, PlacesWithoutAnElementLeavesThemOut) {
  drawn_.absent = [](int row, int column) { return row == 3 || (row + column) % 5 == 0; };

  ASSERT_EQ(find(drawn_.draw()), FinderRefusal::kNone);

  const Comparison result = compare();
  EXPECT_EQ(result.surplus, 0);
  EXPECT_EQ(result.misplaced, 0);
  int drawn = 0;
  for (int row = 0; row < drawn_.rows; ++row) {
    for (int column = 0; column < drawn_.columns; ++column) {
      drawn += drawn_.absent(row, column) ? 0 : 1;
    }
  }
  // On both sides of the empty row. Every other row alone would be a wrong lattice.
  EXPECT_EQ(result.found, drawn);
}

TEST_F(LatticeFinderOn, PlugsWithASmallDarkInsideCostNoneOfTheirNeighbours) {
  drawn_.tilt_deg = 48.0;
  drawn_.distortion = 0.15;
  drawn_.distance = 16.0;
  drawn_.absent = [](int row, int column) { return row % 3 == 1 && column % 4 == 1; };
  const picture::AveragedPicture picture = drawn_.draw();
  int whole = 0;
  for (int row = 0; row < drawn_.rows; ++row) {
    for (int column = 0; column < drawn_.columns; ++column) {
      const Eigen::Vector2d at = drawn_.pixel_of(drawn_.center(row, column));
      if (!drawn_.absent(row, column)) {
        whole += at.x() > 30.0 && at.y() > 30.0 && at.x() < 609.0 && at.y() < 449.0 ? 1 : 0;
      } else {
        const int u = static_cast<int>(at.x());
        const int v = static_cast<int>(at.y());
        for (int i = -6; i <= 6; ++i) {
          const int half = static_cast<int>(std::sqrt(49.0 - i * i));
          drawn_.cover(u - half, v + i, u + half, v + i, 30);
        }
      }
    }
  }

  ASSERT_EQ(find(picture), FinderRefusal::kNone);

  const Comparison result = compare();
  EXPECT_GE(result.found, whole);
  EXPECT_GT(whole, 50);
  EXPECT_EQ(result.surplus, 0);
  EXPECT_EQ(result.misplaced, 0);
}

TEST_F(LatticeFinderOn, FalseSpotsBesideTheLatticeLeavesThemOut) {
  const picture::AveragedPicture picture = drawn_.draw();
  const double half_step =
      0.5 * (drawn_.pixel_of(drawn_.center(0, 1)) - drawn_.pixel_of(drawn_.center(0, 0))).x();
  for (int k = 0; k < 6; ++k) {
    // Small dark squares in the gaps' middles, and a row of like marks outside.
    const Eigen::Vector2d at = drawn_.pixel_of(drawn_.center(k, k));
    const int u = static_cast<int>(at.x() + half_step);
    const int v = static_cast<int>(at.y() + half_step);
    drawn_.cover(u - 3, v - 3, u + 3, v + 3, 30);
    drawn_.cover(10 + 60 * k, 5, 22 + 60 * k, 17, 40);
  }

  ASSERT_EQ(find(picture), FinderRefusal::kNone);

  expect_all(0.1);
}

TEST_F(LatticeFinderOn, ASmudgeWhereADotWouldBeLeavesItOut) {
  drawn_.absent = [](int row, int column) { return row == 7 && column == 8; };
  const picture::AveragedPicture picture = drawn_.draw();
  const Eigen::Vector2d at = drawn_.pixel_of(drawn_.center(7, 8));
  const int u = static_cast<int>(at.x());
  const int v = static_cast<int>(at.y());
  for (int i = -9; i <= 9; ++i) {
    const int half = static_cast<int>(std::sqrt(100.0 - i * i));
    drawn_.cover(u - half, v + i, u + half, v + i, 166);  // of 180
  }

  ASSERT_EQ(find(picture), FinderRefusal::kNone);

  EXPECT_EQ(found_->elements.size(), drawn_.rows * drawn_.columns - 1);
  EXPECT_EQ(compare().surplus, 0);
}

TEST_F(LatticeFinderOn, NothingSaysSo) {
  drawn_.rows = 0;
  drawn_.columns = 0;
  EXPECT_EQ(find(drawn_.draw()), FinderRefusal::kFlat);

  drawn_.noise = 20.0;
  EXPECT_NE(find(drawn_.draw()), FinderRefusal::kNone);
  EXPECT_TRUE(found_->elements.empty());

  drawn_.noise = 0.0;
  drawn_.rows = 1;
  drawn_.columns = 9;
  EXPECT_EQ(find(drawn_.draw()), FinderRefusal::kNoLattice);

  drawn_.rows = 2;
  drawn_.columns = 2;
  EXPECT_EQ(find(drawn_.draw()), FinderRefusal::kNoLattice);
}

TEST_F(LatticeFinderOn, APictureBeyondItsSizesIsRefused) {
  std::vector<std::uint16_t> pixels(4097 * 30);
  std::vector<std::uint16_t> scratch(pixels.size());

  EXPECT_EQ(finder_->find({pixels.data(), 4097, 30}, {}, scratch, *found_), FinderRefusal::kSize);
  EXPECT_EQ(finder_->find({pixels.data(), 30, 23}, {}, scratch, *found_), FinderRefusal::kSize);
}

TEST_F(LatticeFinderOn, TheSamePictureFindsTheSameAndAsksForNoMemory) {
  drawn_.noise = 2.0;
  const picture::AveragedPicture picture = drawn_.draw();
  ASSERT_EQ(find(picture), FinderRefusal::kNone);
  const auto first = std::make_unique<FoundLattice>(*found_);
  std::int64_t allocations = 0;

  {
    const tests::HeapGuard guard;
    static_cast<void>(find(picture));
    allocations = guard.calls().allocations;
  }

  EXPECT_EQ(allocations, 0);
  ASSERT_EQ(found_->elements.size(), first->elements.size());
  for (std::int32_t i = 0; i < first->elements.size(); ++i) {
    EXPECT_EQ(found_->elements[i].row, first->elements[i].row);
    EXPECT_EQ(found_->elements[i].center_px, first->elements[i].center_px);
  }
}

}  // namespace
}  // namespace tubesight::core::detection
