#include "core/base/fixed.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

constexpr std::int32_t kMax = 0x7fffffff;
constexpr std::int32_t kMin = -0x7fffffff - 1;

using Q16 = Fixed<16, 16>;
using Q20 = Fixed<12, 20>;
using Q29 = Fixed<3, 29>;
using Q30 = Fixed<2, 30>;

class FixedTest : public ::testing::Test {
 protected:
  void SetUp() override { static_cast<void>(take_overflow_flag()); }
};

// Bit patterns worked out by hand: value * 2^F, rounded to nearest, ties away from zero.
struct Pattern {
  double value;
  std::int32_t raw;
};

template <typename T, std::size_t N>
void expect_patterns(const Pattern (&patterns)[N]) {
  for (const Pattern& pattern : patterns) {
    EXPECT_EQ(T(pattern.value).raw(), pattern.raw) << pattern.value;
  }
  EXPECT_FALSE(take_overflow_flag());
}

TEST_F(FixedTest, Q16HasThePatternsOfTheTable) {
  expect_patterns<Q16>({{0.0, 0},
                        {1.0, 0x00010000},
                        {-1.0, -0x00010000},
                        {0.5, 0x00008000},
                        {-0.25, -0x00004000},
                        {1.0 / 65536.0, 1},
                        {-1.0 / 65536.0, -1},
                        {32767.0, 0x7fff0000},
                        {32767.9999847412109375, kMax},
                        {-32768.0, kMin},
                        {-32767.9999847412109375, -0x7fffffff}});
}

TEST_F(FixedTest, Q20HasThePatternsOfTheTable) {
  expect_patterns<Q20>({{1.0, 0x00100000},
                        {-2048.0, kMin},
                        {2047.99999904632568359375, kMax},
                        {25.4, 26633830},      // 25.4 * 1048576 = 26633830.4
                        {-18.6, -19503514}});  // 19503513.6
}

TEST_F(FixedTest, Q29AndQ30HaveThePatternsOfTheTable) {
  expect_patterns<Q29>({{1.0, 0x20000000},
                        {-4.0, kMin},
                        {3.999999998137354850769, kMax},
                        {1.8, 966367642}});  // 966367641.6
  expect_patterns<Q30>(
      {{1.0, 0x40000000}, {-2.0, kMin}, {1.999999999068677425385, kMax}, {-1.0, -0x40000000}});
}

TEST_F(FixedTest, ConstructionRoundsTiesAwayFromZero) {
  expect_patterns<Q16>({{0.5 / 65536.0, 1},
                        {-0.5 / 65536.0, -1},
                        {1.5 / 65536.0, 2},
                        {-1.5 / 65536.0, -2},
                        {0.4375 / 65536.0, 0},
                        {-0.4375 / 65536.0, 0}});
}

TEST_F(FixedTest, ConstructionFromIntegersIsExact) {
  EXPECT_EQ(Q16(3).raw(), 3 * 65536);
  EXPECT_EQ(Q16(-32768).raw(), kMin);
  EXPECT_FALSE(take_overflow_flag());
  EXPECT_EQ(Q16(32768).raw(), kMax);
  EXPECT_TRUE(take_overflow_flag());
  EXPECT_EQ(Q30(-3).raw(), kMin);
  EXPECT_TRUE(take_overflow_flag());
}

TEST_F(FixedTest, ConversionBackIsExact) {
  EXPECT_EQ(static_cast<double>(Q16::from_raw(kMin)), -32768.0);
  EXPECT_EQ(static_cast<double>(Q16::from_raw(kMax)), 32767.9999847412109375);
  EXPECT_EQ(static_cast<float>(Q30::from_raw(-0x60000000)), -1.5F);
}

TEST_F(FixedTest, NumbersBeyondTheFormatSaturateAndRaiseTheFlag) {
  const double values[] = {32767.9999999,
                           32768.0,
                           1e18,
                           1e300,
                           std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()};
  for (const double value : values) {
    EXPECT_EQ(Q16(value).raw(), kMax) << value;
    EXPECT_TRUE(take_overflow_flag()) << value;
  }
  for (const double value : {-32768.00001, -1e18, -1e300}) {
    EXPECT_EQ(Q16(value).raw(), kMin) << value;
    EXPECT_TRUE(take_overflow_flag()) << value;
  }
  EXPECT_EQ(Q16(std::numeric_limits<float>::infinity()).raw(), kMax);
}

TEST_F(FixedTest, SumsSaturateAtBothBounds) {
  const Q16 top = Q16::from_raw(kMax);
  const Q16 bottom = Q16::from_raw(kMin);
  const Q16 step = Q16::from_raw(1);
  EXPECT_EQ((top - step).raw(), kMax - 1);
  EXPECT_EQ((bottom + step).raw(), kMin + 1);
  EXPECT_FALSE(take_overflow_flag());
  EXPECT_EQ((top + step).raw(), kMax);
  EXPECT_TRUE(take_overflow_flag());
  EXPECT_EQ((bottom - step).raw(), kMin);
  EXPECT_TRUE(take_overflow_flag());
  EXPECT_EQ((-bottom).raw(), kMax);
  EXPECT_TRUE(take_overflow_flag());
  // The sum that overflows most, and the difference whose left side has no sign.
  EXPECT_EQ((bottom + bottom).raw(), kMin);
  EXPECT_TRUE(take_overflow_flag());
  EXPECT_EQ((Q16{} - bottom).raw(), kMax);
  EXPECT_TRUE(take_overflow_flag());
  EXPECT_EQ((Q16::from_raw(-1) - bottom).raw(), kMax);
  EXPECT_EQ((bottom - Q16{}).raw(), kMin);
  EXPECT_FALSE(take_overflow_flag());
}

TEST_F(FixedTest, TheFlagIsStickyAndTakenOnce) {
  static_cast<void>(Q16::from_raw(kMax) + Q16(1));
  static_cast<void>(Q16(1) + Q16(1));
  EXPECT_TRUE(take_overflow_flag());
  EXPECT_FALSE(take_overflow_flag());
}

TEST_F(FixedTest, ProductsAreExactUntilNarrowedOnce) {
  // 1.5 * -2.25 = -3.375; 3 raw * 1/2 = 1.5 raw, away from zero: 2.
  EXPECT_EQ(narrow<Q16>(product(Q16(1.5), Q16(-2.25))).raw(), -221184);
  EXPECT_EQ(narrow<Q16>(product(Q16::from_raw(3), Q16(0.5))).raw(), 2);
  EXPECT_EQ(narrow<Q16>(product(Q16::from_raw(-3), Q16(0.5))).raw(), -2);
  // Mixed formats: 20 and 30 fraction bits make 50.
  const auto wide = product(Q20(25.5), Q30(-0.5));
  static_assert(decltype(wide)::kFractionBits == 50);
  EXPECT_EQ(wide.raw(), -14355223812243456);  // -12.75 * 2^50
  // Two halves of a step make one; narrowed apart each would have been rounded up: two.
  const auto half = product(Q16::from_raw(1), Q16(0.5));
  EXPECT_EQ(narrow<Q16>(half + half).raw(), 1);
  EXPECT_EQ(narrow<Q16>(half - half - half).raw(), -1);
}

TEST_F(FixedTest, TheLargestProductSaturates) {
  EXPECT_EQ(product(Q16::from_raw(kMin), Q16::from_raw(kMin)).raw(), std::int64_t{1} << 62);
  EXPECT_EQ(narrow<Q16>(product(Q16::from_raw(kMin), Q16::from_raw(kMin))).raw(), kMax);
  EXPECT_TRUE(take_overflow_flag());
  EXPECT_EQ(narrow<Q16>(product(Q16::from_raw(kMin), Q16::from_raw(kMax))).raw(), kMin);
  EXPECT_TRUE(take_overflow_flag());
}

TEST_F(FixedTest, ConvertAndWidenKeepTheValue) {
  EXPECT_EQ((convert<Q20>(Q16(12.25)).raw()), 12845056);  // 12.25 * 2^20
  EXPECT_EQ((convert<Q16>(Q20::from_raw(8)).raw()), 1);   // half a step: away from zero
  EXPECT_EQ((convert<Q16>(Q20::from_raw(-8)).raw()), -1);
  EXPECT_EQ((convert<Q16>(Q20::from_raw(7)).raw()), 0);
  EXPECT_EQ((widen<40>(Q16(-1.5)).raw()), -1649267441664);  // -1.5 * 2^40
  EXPECT_FALSE(take_overflow_flag());
  EXPECT_EQ((convert<Q30>(Q16(2)).raw()), kMax);
  EXPECT_TRUE(take_overflow_flag());
}

TEST_F(FixedTest, QuotientsRoundTiesAwayFromZero) {
  EXPECT_EQ((quotient<Q16>(Q16(1), Q16(3)).raw()), 21845);  // 21845.33
  EXPECT_EQ((quotient<Q16>(Q16(2), Q16(3)).raw()), 43691);  // 43690.67
  EXPECT_EQ((quotient<Q16>(Q16(-2), Q16(3)).raw()), -43691);
  EXPECT_EQ((quotient<Q16>(Q16(2), Q16(-3)).raw()), -43691);
  EXPECT_EQ((quotient<Q16>(Q16::from_raw(1), Q16(2)).raw()), 1);
  EXPECT_EQ((quotient<Q16>(Q16::from_raw(-1), Q16(2)).raw()), -1);
  EXPECT_EQ((quotient<Q29>(Q16(320), Q16(512)).raw()), 335544320);  // 0.625 * 2^29
  EXPECT_FALSE(take_overflow_flag());
  EXPECT_EQ((quotient<Q16>(Q16(32767), Q16(0.5)).raw()), kMax);
  EXPECT_TRUE(take_overflow_flag());
  EXPECT_EQ((quotient<Q29>(Q16::from_raw(kMin), Q16::from_raw(1)).raw()), kMin);
  EXPECT_TRUE(take_overflow_flag());
}

TEST(FixedShift, RoundsToNearestWithTiesAwayFromZero) {
  const struct {
    std::int64_t value;
    int bits;
    std::int64_t expected;
  } rows[] = {{5, 1, 3}, {-5, 1, -3}, {4, 1, 2},   {-4, 1, -2},   {5, 2, 1},   {-5, 2, -1},
              {6, 2, 2}, {-6, 2, -2}, {7, 2, 2},   {-7, 2, -2},   {1, 2, 0},   {-1, 2, 0},
              {9, 0, 9}, {-9, 0, -9}, {3, -4, 48}, {-3, -4, -48}, {-8, 4, -1}, {-7, 4, 0}};
  for (const auto& row : rows) {
    EXPECT_EQ(shift_right_rounded(row.value, row.bits), row.expected)
        << row.value << " >> " << row.bits;
  }
}

TEST(FixedDivide, RoundsToNearestWithTiesAwayFromZero) {
  const struct {
    std::int64_t dividend;
    std::int64_t divisor;
    std::int64_t expected;
  } rows[] = {{7, 2, 4},  {-7, 2, -4}, {7, -2, -4}, {-7, -2, 4}, {1, 3, 0},   {2, 3, 1},
              {-1, 3, 0}, {-2, 3, -1}, {5, 3, 2},   {4, 3, 1},   {6, -4, -2}, {5, -4, -1},
              {0, 5, 0},  {12, 5, 2},  {13, 5, 3},  {-13, 5, -3}};
  for (const auto& row : rows) {
    EXPECT_EQ(divide_rounded(row.dividend, row.divisor), row.expected)
        << row.dividend << " / " << row.divisor;
  }
}

TEST(FixedSquareRoot, IntegerRootsAreTheFloor) {
  const struct {
    std::uint64_t value;
    std::uint32_t root;
  } rows[] = {{0, 0},
              {1, 1},
              {2, 1},
              {3, 1},
              {4, 2},
              {99, 9},
              {100, 10},
              {0xfffffffe00000000, 4294967294},  // one below (2^32 - 1)^2
              {0xfffffffe00000001, 4294967295},
              {0xffffffffffffffff, 4294967295}};
  for (const auto& row : rows) {
    EXPECT_EQ(integer_square_root(row.value), row.root) << row.value;
  }
}

TEST(FixedSquareRoot, IntegerRootsAreRightOnEitherSideOfEverySquare) {
  const auto right_around = [](std::uint64_t root) {
    const std::uint64_t square = root * root;
    EXPECT_EQ(integer_square_root(square - 1), root - 1) << root;
    EXPECT_EQ(integer_square_root(square), root) << root;
    EXPECT_EQ(integer_square_root(square + 2 * root), root) << root;  // the last before the next
  };
  for (std::uint64_t root = 1; root < 70'000; ++root) {
    right_around(root);
  }
  for (std::uint64_t root = 70'000; root < 0xffffffff; root += root / 5'000) {
    right_around(root);
  }
}

TEST(FixedSquareRoot, IsWithinOneStepBelowTheRoot) {
  EXPECT_EQ(square_root(Q16(6.25)).raw(), 163840);  // 2.5
  EXPECT_EQ(square_root(Q30(1)).raw(), 0x40000000);
  EXPECT_EQ(square_root(Q20(2)).raw(), 1482910);  // 1482910.4
  EXPECT_EQ(square_root(Q16(-4)).raw(), 0);
  EXPECT_EQ(square_root(Q16(0)).raw(), 0);
  EXPECT_EQ(square_root(Q16::from_raw(kMax)).raw(), 11863283);  // sqrt(2^47 - 2^16) floor
}

TEST(FixedOracle, OperationsAgreeWithDoubleToHalfAStep) {
  constexpr std::uint32_t kSeed = 20240;
  std::mt19937 random(kSeed);
  const auto next = [&random](std::int32_t bound) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(2 * bound + 1)) - bound;
  };
  static_cast<void>(take_overflow_flag());
  for (int i = 0; i < 20000; ++i) {
    const Q16 a = Q16::from_raw(next(90 * 65536));
    const Q16 b = Q16::from_raw(next(90 * 65536));
    const double x = static_cast<double>(a);
    const double y = static_cast<double>(b);
    constexpr double kHalfStep = 0.5 / 65536.0;
    ASSERT_EQ(static_cast<double>(a + b), x + y) << "seed " << kSeed << " round " << i;
    ASSERT_EQ(static_cast<double>(a - b), x - y) << "seed " << kSeed << " round " << i;
    ASSERT_LE(std::abs(static_cast<double>(narrow<Q16>(product(a, b))) - x * y), kHalfStep)
        << "seed " << kSeed << " round " << i;
    if (std::abs(y) > 0.01) {
      ASSERT_LE(std::abs(static_cast<double>(quotient<Q16>(a, b)) - x / y), kHalfStep + 1e-11)
          << "seed " << kSeed << " round " << i;
    }
    ASSERT_EQ(a < b, x < y);
    ASSERT_EQ(a == b, x == y);
  }
  EXPECT_FALSE(take_overflow_flag());
}

TEST(FixedConstant, ArithmeticWorksAtCompileTime) {
  static_assert(narrow<Q16>(product(Q16(1.5), Q16(2))).raw() == 3 * 65536);
  static_assert(square_root(Q16(9)).raw() == 3 * 65536);
  static_assert((Q16(30000) + Q16(30000)).raw() == kMax);
  static_assert(Q16(2) > Q16(-3));
}

using TrappingQ16 = Fixed<16, 16, TrapOnOverflow>;

TEST(FixedTrapDeathTest, LeavingTheRangeTraps) {
  const TrappingQ16 top = TrappingQ16::from_raw(kMax);
  const TrappingQ16 bottom = TrappingQ16::from_raw(kMin);
  EXPECT_EQ((top - TrappingQ16(1)).raw(), kMax - 65536);
  EXPECT_DEATH(static_cast<void>(top + TrappingQ16::from_raw(1)), "");
  EXPECT_DEATH(static_cast<void>(-bottom), "");
  EXPECT_DEATH(static_cast<void>(narrow<TrappingQ16>(product(top, top))), "");
  EXPECT_DEATH(static_cast<void>(TrappingQ16(40000.0)), "");
}

}  // namespace
}  // namespace tubesight::core
