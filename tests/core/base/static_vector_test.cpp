#include "core/base/static_vector.h"

#include <cstdint>
#include <numeric>
#include <type_traits>

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

using Three = StaticVector<std::int32_t, 3>;
static_assert(std::is_trivially_copyable_v<Three>);
static_assert(Three::capacity() == 3);

// As Eigen's matrices are: copied by a function of their own.
struct Copied {
  Copied() = default;
  Copied(const Copied& other) : value(other.value) {}
  Copied& operator=(const Copied& other) {
    value = other.value;
    return *this;
  }
  std::int32_t value = 0;
};
static_assert(!std::is_trivially_copyable_v<StaticVector<Copied, 2>>);

TEST(StaticVector, HoldsWhatIsCopiedByAFunction) {
  StaticVector<Copied, 2> list;
  Copied one;
  one.value = 3;
  ASSERT_TRUE(list.try_push_back(one));

  const StaticVector<Copied, 2> copy = list;

  ASSERT_EQ(copy.size(), 1);
  EXPECT_EQ(copy[0].value, 3);
}

TEST(StaticVector, StartsEmpty) {
  const Three list;
  EXPECT_EQ(list.size(), 0);
  EXPECT_TRUE(list.empty());
  EXPECT_FALSE(list.full());
  EXPECT_EQ(list.begin(), list.end());
}

TEST(StaticVector, RefusesWhatDoesNotFitAndStaysAsItWas) {
  Three list;
  EXPECT_TRUE(list.try_push_back(10));
  EXPECT_TRUE(list.try_push_back(20));
  EXPECT_FALSE(list.full());
  EXPECT_TRUE(list.try_push_back(30));
  EXPECT_TRUE(list.full());
  EXPECT_FALSE(list.try_push_back(40));
  ASSERT_EQ(list.size(), 3);
  EXPECT_EQ(list[0], 10);
  EXPECT_EQ(list[1], 20);
  EXPECT_EQ(list[2], 30);
}

TEST(StaticVector, IteratesOverItsElementsAlone) {
  Three list;
  ASSERT_TRUE(list.try_push_back(5));
  ASSERT_TRUE(list.try_push_back(7));
  const Three& constant = list;
  EXPECT_EQ(std::accumulate(constant.begin(), constant.end(), 0), 12);
  ASSERT_EQ(constant.view().size(), 2U);
  EXPECT_EQ(constant.view()[1], 7);
  for (std::int32_t& value : list) {
    value *= 2;
  }
  EXPECT_EQ(list[0], 10);
  EXPECT_EQ(constant[1], 14);
}

TEST(StaticVector, TruncatesAndClears) {
  Three list;
  ASSERT_TRUE(list.try_push_back(1));
  ASSERT_TRUE(list.try_push_back(2));
  list.truncate(2);
  EXPECT_EQ(list.size(), 2);
  list.truncate(1);
  EXPECT_EQ(list.size(), 1);
  EXPECT_EQ(list[0], 1);
  list.clear();
  EXPECT_TRUE(list.empty());
  ASSERT_TRUE(list.try_push_back(9));
  EXPECT_EQ(list[0], 9);
}

TEST(StaticVectorDeathTest, IndicesOutsideTrap) {
  Three list;
  ASSERT_TRUE(list.try_push_back(1));
  const Three& constant = list;
  EXPECT_DEATH(static_cast<void>(list[1]), "");
  EXPECT_DEATH(static_cast<void>(list[-1]), "");
  EXPECT_DEATH(static_cast<void>(constant[1]), "");
  EXPECT_DEATH(list.truncate(2), "");
  EXPECT_DEATH(list.truncate(-1), "");
}

}  // namespace
}  // namespace tubesight::core
