#include "core/base/constant.h"

#include <gtest/gtest.h>

#include "tests/support/scalars.h"

namespace tubesight::core {
namespace {

template <typename S>
class ConstantOf : public ::testing::Test {};
using tests::Scalars;
TYPED_TEST_SUITE(ConstantOf, Scalars);

TYPED_TEST(ConstantOf, IsTheNearestMultipleOfASmallStepInEveryArithmetic) {
  using M = Mm<TypeParam>;
  EXPECT_EQ(static_cast<double>(constant<M>(0.4)), 410.0 / 1024.0);
  EXPECT_EQ(static_cast<double>(constant<M>(-0.4)), -410.0 / 1024.0);
  EXPECT_EQ(static_cast<double>(constant<M>(0.032)), 33.0 / 1024.0);
  EXPECT_EQ(static_cast<double>(constant<M>(1500.0)), 1500.0);
  EXPECT_EQ(static_cast<double>(constant<M>(0.0)), 0.0);
  EXPECT_EQ(static_cast<double>(constant<Unit<TypeParam>>(0.5)), 0.5);
  EXPECT_EQ(static_cast<double>(constant<Ratio<TypeParam>>(-4.0)), -4.0) << "the format's end";
}

TYPED_TEST(ConstantOf, HasMoreBitsWhereTheyAreAskedFor) {
  using M = Mm<TypeParam>;
  // 0.1 * 65536 = 6553.6.
  EXPECT_EQ(static_cast<double>(constant<M, 16>(0.1)), 6554.0 / 65536.0);
  EXPECT_EQ(static_cast<double>(constant<M, 16>(-0.0001)), -7.0 / 65536.0);
}

static_assert(constant<Mm<FixedPoint>>(0.4) == from_scaled<Mm<FixedPoint>>(410, 10));
static_assert(constant<Mm<FixedPoint>>(1.415) == from_scaled<Mm<FixedPoint>>(1449, 10));

}  // namespace
}  // namespace tubesight::core
