#include "core/calibration/target_order.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace tubesight::core::calibration {
namespace {

/// A lattice as a finder tells it: (row, column) stands at row * `row` + column * `column`.
class TargetOrder : public ::testing::Test {
 protected:
  void found_at(const Eigen::Vector2d& column, const Eigen::Vector2d& row, double dot_mm) {
    found_->dark = true;
    found_->steps = {column / (0.5 * dot_mm), row / (0.5 * dot_mm)};
    column_ = column;
    row_ = row;
  }
  void add(int row, int column) {
    detection::LatticeElement element;
    element.row = row;
    element.column = column;
    element.centroid_px << 100 * column, 100 * row;
    element.contrast = 100.0;
    ASSERT_TRUE(found_->elements.try_push_back(element));
  }
  /// The place that an element was given, or one far away.
  [[nodiscard]] Eigen::Vector2d given(int row, int column) const {
    for (const SeenDot& dot : *dots_) {
      if (dot.seen_px == Eigen::Vector2d(100 * column, 100 * row)) {
        return dot.place_mm.head<2>();
      }
    }
    return {1e9, 1e9};
  }
  /// Whether places given differ as those drawn do, but for a turn.
  void expect_rigid() const {
    for (const auto& a : found_->elements) {
      for (const auto& b : found_->elements) {
        const Eigen::Vector2d drawn = (a.column - b.column) * column_ + (a.row - b.row) * row_;
        EXPECT_NEAR((given(a.row, a.column) - given(b.row, b.column)).norm(), drawn.norm(), 1e-9);
      }
    }
  }

  OrderRefusal order() { return order_on_target(*found_, target_, *dots_); }

  Target target_{4, 6, TargetLattice::kSquare, 8.0, 8.0, 4.0, false};
  Eigen::Vector2d column_;
  Eigen::Vector2d row_;
  std::unique_ptr<detection::FoundLattice> found_ = std::make_unique<detection::FoundLattice>();
  std::unique_ptr<StaticVector<SeenDot, kMaxDots>> dots_ =
      std::make_unique<StaticVector<SeenDot, kMaxDots>>();
};

TEST_F(TargetOrder, OfASquareTemplateSeenOnItsSideTurnsIt) {
  found_at({8.0, 0.0}, {0.0, 8.0}, 4.0);
  for (int i = 0; i < 24; ++i) {
    add(i / 4, i % 4);  // six rows of four: lines run down
  }

  ASSERT_EQ(order(), OrderRefusal::kNone);

  EXPECT_EQ(dots_->size(), 24);
  expect_rigid();
  // Rightwards along the template is a quarter turn from downwards across it, not its mirror image.
  const Eigen::Vector2d along = given(0, 1) - given(0, 0);
  const Eigen::Vector2d down = given(1, 0) - given(0, 0);
  EXPECT_NEAR(along.x() * down.y() - along.y() * down.x(), 64.0, 1e-9);
}

TEST_F(TargetOrder, OfAStaggeredTemplateFollowsItsLines) {
  target_ = {5, 3, TargetLattice::kStaggered, 2.0, 1.0, 0.6, false};
  // Found by its shortest steps, (1, 1) and (-1, 1): a square lattice on its corner.
  found_at({1.0, 1.0}, {-1.0, 1.0}, 0.6);
  for (int line = 0; line < 5; ++line) {
    for (int dot = 0; dot < 3; ++dot) {
      const int halves = 2 * dot + line % 2;
      add((line - halves) / 2 + 10, (line + halves) / 2);
    }
  }

  ASSERT_EQ(order(), OrderRefusal::kNone);

  EXPECT_EQ(dots_->size(), 15);
  expect_rigid();
}

TEST_F(TargetOrder, BearsAMissingDotAndAStrayOne) {
  found_at({8.0, 0.0}, {0.0, 8.0}, 4.0);
  target_.rows = 6;
  for (int i = 0; i < 36; ++i) {
    if (i != 14) {
      add(i / 6, i % 6);
    }
  }
  add(6, 2);

  ASSERT_EQ(order(), OrderRefusal::kNone);

  EXPECT_EQ(dots_->size(), 35);
  EXPECT_GT(given(6, 2).x(), 1e8);
}

TEST_F(TargetOrder, LeavesOutADotWhoseCentroidThePictureCutsOff) {
  found_at({8.0, 0.0}, {0.0, 8.0}, 4.0);
  for (int i = 0; i < 24; ++i) {
    add(i / 6, i % 6);
  }
  found_->elements[5].contrast = -1.0;  // the last of the first line: the template ends there

  ASSERT_EQ(order(), OrderRefusal::kNone);

  EXPECT_EQ(dots_->size(), 23);
  EXPECT_GT(given(0, 5).x(), 1e8);
  EXPECT_EQ((given(0, 4) - given(0, 3)).norm(), 8.0);
}

TEST_F(TargetOrder, OfAnotherTemplateIsRefused) {
  found_at({8.0, 0.0}, {0.0, 8.0}, 4.0);
  for (int i = 0; i < 24; ++i) {
    add(i / 6, i % 6);
  }
  Target other = target_;
  other.rows = 5;
  EXPECT_EQ(order_on_target(*found_, other, *dots_), OrderRefusal::kCount);
  other = target_;
  other.columns = 5;
  EXPECT_EQ(order_on_target(*found_, other, *dots_), OrderRefusal::kCount);
  other = target_;
  other.spacing_mm = 12.0;
  EXPECT_EQ(order_on_target(*found_, other, *dots_), OrderRefusal::kForm);
  other = target_;
  other.bright = true;
  EXPECT_EQ(order_on_target(*found_, other, *dots_), OrderRefusal::kColour);
  EXPECT_TRUE(dots_->empty());
}

}  // namespace
}  // namespace tubesight::core::calibration
