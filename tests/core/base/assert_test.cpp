#include "core/base/assert.h"

#include <cstdio>

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

void telling_hook(const char* expression, const char* file, int line) {
  std::fprintf(stderr, "hook: %s at %s:%d\n", expression, file, line);
}

TEST(Assert, EvaluatesItsConditionOnce) {
  int count = 0;
  TUBESIGHT_ASSERT(++count == 1);
  EXPECT_EQ(count, 1);
}

TEST(AssertDeathTest, CallsTheHookWithThePlaceAndTrapsWhenItReturns) {
  EXPECT_DEATH(
      {
        set_panic_hook(telling_hook);
        TUBESIGHT_ASSERT(1 + 1 == 3);
      },
      "hook: 1 \\+ 1 == 3 at .*assert_test\\.cpp:[0-9]+");
}

TEST(AssertDeathTest, TrapsWithoutAHook) {
  EXPECT_EXIT(
      {
        set_panic_hook(nullptr);
        TUBESIGHT_ASSERT(false);
      },
      [](int status) { return status != 0; }, "");
}

}  // namespace
}  // namespace tubesight::core
