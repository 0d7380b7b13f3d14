#include "core/base/scalar.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/vector3.h"
#include "tests/support/scalars.h"

namespace tubesight::core {
namespace {

template <typename S>
class ScalarTest : public ::testing::Test {
 protected:
  void SetUp() override { static_cast<void>(take_overflow_flag()); }
  void TearDown() override { EXPECT_FALSE(take_overflow_flag()); }
};

using tests::Scalars;
TYPED_TEST_SUITE(ScalarTest, Scalars);

// All expected values below are exact in every format, so that no bound is needed.

TYPED_TEST(ScalarTest, FromScaledCountsStepsOfAPowerOfTwo) {
  using S = TypeParam;
  EXPECT_EQ(static_cast<double>(from_scaled<Px<S>>(5, 1)), 2.5);
  EXPECT_EQ(static_cast<double>(from_scaled<Mm<S>>(-3, 2)), -0.75);
  EXPECT_EQ(static_cast<double>(from_scaled<Ratio<S>>(1843, 10)), 1.7998046875);
  EXPECT_EQ(static_cast<double>(from_scaled<Unit<S>>(-1, 0)), -1.0);
}

TYPED_TEST(ScalarTest, ToScaledRoundsTiesAwayFromZero) {
  using S = TypeParam;
  EXPECT_EQ(to_scaled(Mm<S>(2.5), 0), 3);
  EXPECT_EQ(to_scaled(Mm<S>(-2.5), 0), -3);
  EXPECT_EQ(to_scaled(Mm<S>(2.4375), 0), 2);
  EXPECT_EQ(to_scaled(Mm<S>(-2.4375), 0), -2);
  EXPECT_EQ(rounded(Mm<S>(-2.5)), -3);
  EXPECT_EQ(rounded(Mm<S>(2.4375)), 2);
  EXPECT_EQ(to_scaled(Px<S>(-1.25), 16), -81920);
  EXPECT_EQ(to_scaled(Mm<S>(0.3125), 3), 3);  // 2.5 steps
  EXPECT_EQ(to_scaled(Unit<S>(-0.5), 30), -536870912);
}

TYPED_TEST(ScalarTest, ArithmeticHelpersFollowTheirFormulas) {
  using S = TypeParam;
  EXPECT_EQ(times(Mm<S>(-12.5), Unit<S>(0.5)), Mm<S>(-6.25));
  EXPECT_EQ((quotient<Ratio<S>>(Px<S>(-96), Px<S>(64))), Ratio<S>(-1.5));
  EXPECT_EQ(absolute(Mm<S>(-3.5)), Mm<S>(3.5));
  EXPECT_EQ(absolute(Mm<S>(3.5)), Mm<S>(3.5));
  EXPECT_EQ(square_root(Mm<S>(42.25)), Mm<S>(6.5));
  EXPECT_EQ(square_root(Mm<S>(-1)), Mm<S>(0));
  EXPECT_EQ((convert<Ratio<S>>(Mm<S>(-1.25))), Ratio<S>(-1.25));
}

TYPED_TEST(ScalarTest, DotAndCrossFollowTheirFormulas) {
  using S = TypeParam;
  const Vector3<Mm<S>> a{Mm<S>(2), Mm<S>(-3), Mm<S>(5)};
  const Vector3<Unit<S>> b{Unit<S>(0.5), Unit<S>(0.25), Unit<S>(-1.5)};
  EXPECT_EQ(narrow<Mm<S>>(dot(a, b)), Mm<S>(-7.25));  // 1 - 0.75 - 7.5
  // (-3 * -1.5 - 5 * 0.25, 5 * 0.5 - 2 * -1.5, 2 * 0.25 - -3 * 0.5)
  const Vector3<Mm<S>> expected{Mm<S>(3.25), Mm<S>(5.5), Mm<S>(2)};
  EXPECT_EQ(cross<Mm<S>>(a, b), expected);
  EXPECT_EQ((a + a - a), a);
  const Vector2<Px<S>> p{Px<S>(1), Px<S>(2)};
  const Vector2<Px<S>> q{Px<S>(4), Px<S>(-2)};
  EXPECT_EQ(p + q, (Vector2<Px<S>>{Px<S>(5), Px<S>(0)}));
  EXPECT_EQ(p - q, (Vector2<Px<S>>{Px<S>(-3), Px<S>(4)}));
}

TYPED_TEST(ScalarTest, FormatsHoldWhatTheirCommentsSay) {
  using S = TypeParam;
  EXPECT_EQ(static_cast<double>(Px<S>(-32768)), -32768.0);
  EXPECT_EQ(static_cast<double>(Mm<S>(2047.5)), 2047.5);
  EXPECT_EQ(static_cast<double>(Unit<S>(-2)), -2.0);
  EXPECT_EQ(static_cast<double>(Ratio<S>(3.75)), 3.75);
}

TEST(ToScaled, BoundsFloatingPointTo32Bits) {
  EXPECT_EQ(to_scaled(1e30, 4), 2147483647);
  EXPECT_EQ(to_scaled(-1e30, 4), -2147483647);
  EXPECT_EQ(to_scaled(std::numeric_limits<float>::infinity(), 0), 2147483647);
  EXPECT_EQ(to_scaled(std::numeric_limits<double>::quiet_NaN(), 0), 2147483647);
}

TEST(ToScaled, SaturatesFixedPointWithTheFlag) {
  static_cast<void>(take_overflow_flag());
  EXPECT_EQ(to_scaled(Px<FixedPoint>(30000), 20), 2147483647);
  EXPECT_TRUE(take_overflow_flag());
}

}  // namespace
}  // namespace tubesight::core
