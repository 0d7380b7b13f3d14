#include "core/tracking/rim_search.h"

#include <gtest/gtest.h>

#include "tests/core/edges/picture.h"
#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

// A circle of 30 px radius about (100.25, 80.5), and what a rim predicted `off` beside it meets.
template <typename S>
class RimSearch : public ::testing::Test {
 protected:
  static constexpr double kU = 100.25;
  static constexpr double kV = 80.5;
  static constexpr double kRadius = 30.0;

  RimSearch() {
    edges::Ellipse circle;
    circle.u = kU;
    circle.v = kV;
    circle.half_u = kRadius;
    circle.half_v = kRadius;
    picture_.draw(circle);
  }

  // The rim point at `angle` of a circle predicted at the true one's centre plus (u, v).
  [[nodiscard]] RimMiss search(double angle, double u, double v, Parity parity = Parity::kEven) {
    const Vector2<Px<S>> point{Px<S>(kU + u + kRadius * std::cos(angle)),
                               Px<S>(kV + v + kRadius * std::sin(angle))};
    const Vector2<Px<S>> tangent{Px<S>(-kRadius * std::sin(angle)),
                                 Px<S>(kRadius * std::cos(angle))};
    edges::DynamicThreshold threshold(200);
    equation_ = {};
    return search_rim<S>(picture_.field(parity), point, tangent, {Px<S>(kU + u), Px<S>(kV + v)}, {},
                         threshold, equation_);
  }

  edges::Picture picture_{200, 160};
  RimEquation<S> equation_{};
};
TYPED_TEST_SUITE(RimSearch, Scalars);

TYPED_TEST(RimSearch, MeetsTheRimWhereItIsPredictedAllAround) {
  for (const Parity parity : {Parity::kEven, Parity::kOdd, Parity::kProgressive}) {
    for (int k = 0; k < 24; ++k) {
      const double angle = k * 0.2617994;
      ASSERT_EQ(this->search(angle, 0.0, 0.0, parity), RimMiss::kNone) << k;
      EXPECT_NEAR(number(this->equation_.distance), 0.0, 0.12) << k;
      EXPECT_NEAR(this->equation_.contrast, 140, 6) << k;
    }
  }
}

TYPED_TEST(RimSearch, GivesTheDistanceThatItsEquationSays) {
  // The predicted circle is (du, dv) beside the true one: the shift that the equation must yield is
  // (-du, -dv).
  for (int k = 0; k < 24; ++k) {
    for (const auto& [u, v] : {std::pair{1.5, 0.0}, {0.0, -1.5}, {-1.0, 1.2}}) {
      ASSERT_EQ(this->search(k * 0.2617994, u, v), RimMiss::kNone) << k;
      const double slope = number(this->equation_.slope);
      const double expected = this->equation_.along_line ? -u + slope * v : -v + slope * u;
      // The rim bends over the shift: by shift^2 / 2 radius along its normal.
      EXPECT_NEAR(number(this->equation_.distance), expected, 0.25 * (1.0 + std::abs(slope))) << k;
      EXPECT_NEAR(number(this->equation_.weight), 1.0 / (1.0 + slope * slope), 1e-3);
    }
  }
}

TYPED_TEST(RimSearch, SearchesAlongLinesAtTheSidesAndAlongColumnsAboveAndBelow) {
  ASSERT_EQ(this->search(0.0, 0.0, 0.0), RimMiss::kNone);
  EXPECT_TRUE(this->equation_.along_line);
  // A rim that grows by 1 px per 32 px moves outwards by 30 / 32 there, to the right.
  EXPECT_NEAR(number(this->equation_.reach), 30.0 / 32.0, 0.02);
  ASSERT_EQ(this->search(1.5707963, 0.0, 0.0), RimMiss::kNone);
  EXPECT_FALSE(this->equation_.along_line);
  EXPECT_NEAR(number(this->equation_.reach), 30.0 / 32.0, 0.02);
  ASSERT_EQ(this->search(3.1415926, 0.0, 0.0), RimMiss::kNone);
  EXPECT_NEAR(number(this->equation_.reach), -30.0 / 32.0, 0.02);
}

TYPED_TEST(RimSearch, SaysWhenThereIsNoEdge) {
  this->picture_ = edges::Picture(200, 160, 30);
  EXPECT_EQ(this->search(0.0, 0.0, 0.0), RimMiss::kNoEdge);
  EXPECT_EQ(this->search(1.5707963, 0.0, 0.0), RimMiss::kNoEdge);
}

TYPED_TEST(RimSearch, SaysWhenThePictureEnds) {
  for (const auto& [u, v] : {std::pair{68.0, 0.0},
                             {-129.0, 0.0},
                             {300.0, 0.0},
                             {0.0, 300.0},
                             {0.0, -300.0},
                             {-500.0, -500.0}}) {
    for (int k = 0; k < 24; ++k) {
      const RimMiss miss = this->search(k * 0.2617994, u, v);
      if (std::abs(u) > 150.0 || std::abs(v) > 150.0) {
        EXPECT_EQ(miss, RimMiss::kOutside) << u << ", " << v << ", point " << k;
      }
    }
  }
  EXPECT_EQ(this->search(0.0, 68.0, 0.0), RimMiss::kOutside) << "at the right border";
}

}  // namespace
}  // namespace tubesight::core::tracking
