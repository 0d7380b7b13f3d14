#include "core/base/spsc_queue.h"

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

TEST(SpscQueue, IsEmptyAtFirst) {
  SpscQueue<int, 4> queue;
  int value = 7;

  EXPECT_FALSE(queue.try_pop(value));
  EXPECT_EQ(value, 7);
  EXPECT_EQ(queue.size(), 0U);
  EXPECT_EQ(queue.capacity(), 4U);
}

TEST(SpscQueue, HandsOutInOrder) {
  SpscQueue<int, 4> queue;
  int value = 0;

  ASSERT_TRUE(queue.try_push(1));
  ASSERT_TRUE(queue.try_push(2));
  EXPECT_EQ(queue.size(), 2U);

  ASSERT_TRUE(queue.try_pop(value));
  EXPECT_EQ(value, 1);
  ASSERT_TRUE(queue.try_pop(value));
  EXPECT_EQ(value, 2);
  EXPECT_FALSE(queue.try_pop(value));
}

TEST(SpscQueue, RefusesWhenFullAndKeepsWhatItHas) {
  SpscQueue<int, 2> queue;
  int value = 0;
  ASSERT_TRUE(queue.try_push(1));
  ASSERT_TRUE(queue.try_push(2));

  EXPECT_FALSE(queue.try_push(3));

  ASSERT_TRUE(queue.try_pop(value));
  EXPECT_EQ(value, 1);
  EXPECT_TRUE(queue.try_push(3));
  ASSERT_TRUE(queue.try_pop(value));
  EXPECT_EQ(value, 2);
  ASSERT_TRUE(queue.try_pop(value));
  EXPECT_EQ(value, 3);
}

TEST(SpscQueue, GoesRoundManyTimes) {
  SpscQueue<int, 4> queue;

  for (int i = 0; i < 1000; ++i) {
    int value = -1;
    ASSERT_TRUE(queue.try_push(2 * i));
    ASSERT_TRUE(queue.try_push(2 * i + 1));
    ASSERT_TRUE(queue.try_pop(value));
    EXPECT_EQ(value, 2 * i);
    ASSERT_TRUE(queue.try_pop(value));
    EXPECT_EQ(value, 2 * i + 1);
  }
}

}  // namespace
}  // namespace tubesight::core
