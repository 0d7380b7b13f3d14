#include "core/overlay/mark_scale.h"

#include <gtest/gtest.h>

namespace tubesight::core::overlay {
namespace {

TEST(MarkScale, GivesLengthsInProportionToTheWidth) {
  EXPECT_EQ(MarkScale(640).px(5), 5);
  EXPECT_EQ(MarkScale(635).px(35), 35);
  EXPECT_EQ(MarkScale(1920).px(5), 15);
  EXPECT_EQ(MarkScale(320).px(5), 3);  // two and a half
  EXPECT_EQ(MarkScale(1280).px(1), 2);
}

TEST(MarkScale, KeepsEverythingVisibleAndBounded) {
  EXPECT_EQ(MarkScale(64).px(1), 1);
  EXPECT_EQ(MarkScale(1).px(0), 1);
  EXPECT_EQ(MarkScale(1 << 24).px(1000), 2048);
}

TEST(MarkScale, LettersGrowInWholeDots) {
  EXPECT_EQ(MarkScale(64).text(), 1);
  EXPECT_EQ(MarkScale(1269).text(), 1);
  EXPECT_EQ(MarkScale(1280).text(), 2);
  EXPECT_EQ(MarkScale(1920).text(), 3);
  EXPECT_EQ(MarkScale(1 << 24).text(), 16);
}

}  // namespace
}  // namespace tubesight::core::overlay
