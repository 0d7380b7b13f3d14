#include "board/box/advice.h"

#include <gtest/gtest.h>

#include "core/base/words.h"

namespace tubesight::board {
namespace {

template <typename E>
void expect_advice() {
  EXPECT_TRUE(advice_of(E::kNone).empty());
  for (std::int32_t i = 1; i < core::count_of<E>(); ++i) {
    const auto value = static_cast<E>(i);
    EXPECT_TRUE(advice_of(value).ends_with('.')) << core::name_of(value);
  }
}

TEST(Advice, IsThereForEachReason) { expect_advice<core::Reason>(); }
TEST(Advice, IsThereForEachRefusedStart) { expect_advice<core::StartRefusal>(); }

}  // namespace
}  // namespace tubesight::board
