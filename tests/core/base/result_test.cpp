#include "core/base/result.h"

#include <cstdint>
#include <memory>
#include <type_traits>

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

static_assert(std::is_trivially_copyable_v<Result<std::int32_t>>);
static_assert(std::is_trivially_copyable_v<Result<void>>);
static_assert(!std::is_convertible_v<Error, Result<std::int32_t>>);
static_assert(!std::is_convertible_v<Result<std::int32_t>, bool>);

struct Pair {
  int first = 0;
  int second = 0;
};

TEST(ResultValue, IsReadByStarAndArrow) {
  Result<Pair> result = Pair{3, 4};
  ASSERT_TRUE(result.has_value());
  ASSERT_TRUE(static_cast<bool>(result));
  EXPECT_EQ((*result).first, 3);
  EXPECT_EQ(result->second, 4);
  result->second = 9;
  (*result).first = 8;
  const Result<Pair>& constant = result;
  EXPECT_EQ(constant->second, 9);
  EXPECT_EQ((*constant).first, 8);
}

TEST(ResultValue, MovesOutOfATemporary) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(5);
  ASSERT_TRUE(result.has_value());
  const std::unique_ptr<int> taken = *std::move(result);
  ASSERT_NE(taken, nullptr);
  EXPECT_EQ(*taken, 5);
}

TEST(ResultError, IsKept) {
  const Result<int> result = Unexpected(Error::kTimeout);
  EXPECT_FALSE(result.has_value());
  EXPECT_FALSE(static_cast<bool>(result));
  EXPECT_EQ(result.error(), Error::kTimeout);
}

TEST(ResultError, ValueOrGivesTheFallback) {
  EXPECT_EQ(Result<int>(Unexpected(Error::kIo)).value_or(7), 7);
  EXPECT_EQ(Result<int>(6).value_or(7), 6);
}

TEST(ResultVoid, IsGoodByDefault) {
  const Result<void> good;
  const Result<void> bad = Unexpected(Error::kDataLoss);
  EXPECT_TRUE(good.has_value());
  EXPECT_TRUE(static_cast<bool>(good));
  EXPECT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error(), Error::kDataLoss);
}

Result<void> step(bool good, int& steps) {
  ++steps;
  if (!good) {
    return Unexpected(Error::kOutOfRange);
  }
  return {};
}

Result<int> three_steps(int failing, int& steps) {
  TUBESIGHT_TRY(step(failing != 1, steps));
  TUBESIGHT_TRY(step(failing != 2, steps));
  if (failing == 3)
    TUBESIGHT_TRY(step(false, steps));
  return 42;
}

TEST(ResultTry, PassesTheFirstErrorOn) {
  for (int failing = 1; failing <= 2; ++failing) {
    int steps = 0;
    const Result<int> result = three_steps(failing, steps);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error(), Error::kOutOfRange);
    EXPECT_EQ(steps, failing);
  }
  int steps = 0;
  EXPECT_EQ(three_steps(3, steps).value_or(0), 0);
  EXPECT_EQ(steps, 3);
}

TEST(ResultTry, GoesOnAfterGoodSteps) {
  int steps = 0;
  const Result<int> result = three_steps(0, steps);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(*result, 42);
  EXPECT_EQ(steps, 2);
}

TEST(ResultDeathTest, ReadingWhatIsNotThereTraps) {
  Result<Pair> failed = Unexpected(Error::kIo);
  const Result<Pair>& constant = failed;
  EXPECT_DEATH(static_cast<void>(*failed), "");
  EXPECT_DEATH(static_cast<void>(*constant), "");
  EXPECT_DEATH(static_cast<void>(failed->first), "");
  EXPECT_DEATH(static_cast<void>(constant->first), "");
  EXPECT_DEATH(static_cast<void>(Result<Pair>(Pair{}).error()), "");
  EXPECT_DEATH(static_cast<void>(Result<void>().error()), "");
}

}  // namespace
}  // namespace tubesight::core
