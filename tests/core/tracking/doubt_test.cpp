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
  doubt.agree(3);
  EXPECT_FALSE(doubt.contradicted());
  EXPECT_TRUE(doubt.lasts()) << "one may be false and happen to fit";
  doubt.agree(3);
  EXPECT_FALSE(doubt.lasts());
}

TEST(Doubt, IsNotEndedByTwoTubeEnds) {
  Doubt doubt;
  doubt.raise(Reason::kJump);
  for (int field = 0; field < 10; ++field) {
    doubt.agree(2);
  }
  EXPECT_FALSE(doubt.contradicted());
  EXPECT_TRUE(doubt.lasts()) << "two agree with each other somewhere in any pattern";
  doubt.agree(3);
  doubt.agree(3);
  EXPECT_FALSE(doubt.lasts());
}

TEST(Doubt, CountsAnewWhenAnotherPictureContradicts) {
  Doubt doubt;
  doubt.raise(Reason::kJump);
  doubt.agree(3);
  doubt.raise(Reason::kNoTubes);
  EXPECT_EQ(doubt.reason(), Reason::kNoTubes);
  doubt.agree(3);
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
