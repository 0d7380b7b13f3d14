#include "core/math/polynomial.h"

#include <gtest/gtest.h>

namespace tubesight::core::math {
namespace {

TEST(RealRoots, FindsFourOfAQuartic) {
  // (x - 1)(x - 2)(x + 3)(x - 0.5) = x^4 - 0.5 x^3 - 7 x^2 + 9.5 x - 3
  const Quartic quartic = {-3.0, 9.5, -7.0, -0.5, 1.0};

  const auto roots = real_roots(quartic, -10.0, 10.0);

  ASSERT_EQ(roots.size(), 4);
  EXPECT_NEAR(roots[0], -3.0, 1e-12);
  EXPECT_NEAR(roots[1], 0.5, 1e-12);
  EXPECT_NEAR(roots[2], 1.0, 1e-12);
  EXPECT_NEAR(roots[3], 2.0, 1e-12);
}

TEST(RealRoots, LeavesOutComplexOnesAndThoseOutside) {
  // (x^2 + 1)(x - 3)(x + 2) = x^4 - x^3 - 5 x^2 - x - 6
  const auto roots = real_roots({-6.0, -1.0, -5.0, -1.0, 1.0}, 0.0, 10.0);

  ASSERT_EQ(roots.size(), 1);
  EXPECT_NEAR(roots[0], 3.0, 1e-12);
}

TEST(RealRoots, GivesATouchingPointOnce) {
  // (x - 1)^2 (x^2 + 4) = x^4 - 2 x^3 + 5 x^2 - 8 x + 4
  const auto roots = real_roots({4.0, -8.0, 5.0, -2.0, 1.0}, -5.0, 5.0);

  ASSERT_EQ(roots.size(), 1);
  EXPECT_NEAR(roots[0], 1.0, 1e-6);
}

TEST(RealRoots, SolvesLowerDegrees) {
  const auto square = real_roots({-4.0, 0.0, 1.0, 0.0, 0.0}, -5.0, 5.0);
  const auto line = real_roots({-4.0, 2.0, 0.0, 0.0, 0.0}, -5.0, 5.0);

  ASSERT_EQ(square.size(), 2);
  EXPECT_NEAR(square[0], -2.0, 1e-12);
  EXPECT_NEAR(square[1], 2.0, 1e-12);
  ASSERT_EQ(line.size(), 1);
  EXPECT_NEAR(line[0], 2.0, 1e-12);
}

}  // namespace
}  // namespace tubesight::core::math
