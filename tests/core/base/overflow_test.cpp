#include "core/base/overflow.h"

#include <thread>

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

TEST(OverflowFlag, StaysUntilTaken) {
  static_cast<void>(take_overflow_flag());
  EXPECT_FALSE(take_overflow_flag());
  raise_overflow_flag();
  raise_overflow_flag();
  EXPECT_TRUE(take_overflow_flag());
  EXPECT_FALSE(take_overflow_flag());
}

TEST(OverflowFlag, BelongsToItsThread) {
  static_cast<void>(take_overflow_flag());
  bool other_saw = false;
  std::thread other([&other_saw] {
    raise_overflow_flag();
    other_saw = take_overflow_flag();
    raise_overflow_flag();
  });
  other.join();
  EXPECT_TRUE(other_saw);
  EXPECT_FALSE(take_overflow_flag());
}

TEST(OverflowFlag, IsRaisedByTheSaturatingPolicyAlone) {
  static_cast<void>(take_overflow_flag());
  EXPECT_EQ(SaturateSticky::too_large(), 2147483647);
  EXPECT_TRUE(take_overflow_flag());
  EXPECT_EQ(SaturateSticky::too_small(), -2147483647 - 1);
  EXPECT_TRUE(take_overflow_flag());
}

TEST(OverflowDeathTest, TheTrappingPolicyEndsTheProgram) {
  EXPECT_DEATH(static_cast<void>(TrapOnOverflow::too_large()), "");
  EXPECT_DEATH(static_cast<void>(TrapOnOverflow::too_small()), "");
}

}  // namespace
}  // namespace tubesight::core
