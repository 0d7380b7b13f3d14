#include "core/tracking/doubt.h"

#include <gtest/gtest.h>

namespace tubesight::core::tracking {
namespace {

TEST(Doubt, IsNoneAtFirst) {
  const Doubt doubt;
  EXPECT_FALSE(doubt.contradicted());
  EXPECT_FALSE(doubt.lasts());
  EXPECT_FALSE(doubt.is_certainty());
}

TEST(Doubt, LastsUntilTwoFieldsInARowAgree) {
  Doubt doubt;
  doubt.raise(Reason::kJump);
  EXPECT_TRUE(doubt.contradicted());
  EXPECT_TRUE(doubt.lasts());
  EXPECT_EQ(doubt.reason(), Reason::kJump);
  doubt.agree();
  EXPECT_FALSE(doubt.contradicted());
  EXPECT_TRUE(doubt.lasts()) << "one may be false and happen to fit";
  doubt.agree();
  EXPECT_FALSE(doubt.lasts());
}

TEST(Doubt, CountsAnewWhenAnotherPictureContradicts) {
  Doubt doubt;
  doubt.raise(Reason::kJump);
  doubt.agree();
  doubt.raise(Reason::kNoTubes);
  EXPECT_EQ(doubt.reason(), Reason::kNoTubes);
  doubt.agree();
  EXPECT_TRUE(doubt.lasts());
  EXPECT_FALSE(doubt.is_certainty()) << "not in a row";
}

TEST(Doubt, IsCertaintyAfterThreeContradictionsInARow) {
  Doubt doubt;
  doubt.raise(Reason::kJump);
  doubt.raise(Reason::kJump);
  EXPECT_FALSE(doubt.is_certainty());
  doubt.raise(Reason::kJump);
  EXPECT_TRUE(doubt.is_certainty());
  doubt.clear();
  EXPECT_FALSE(doubt.is_certainty());
  EXPECT_FALSE(doubt.lasts());
}

}  // namespace
}  // namespace tubesight::core::tracking
