#include "board/visionbox/silent_link.h"

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using std::chrono::seconds;

TEST(SilentLink, TheLampHoldsUnlessItIsSetOtherwise) {
  SilentLink link({seconds(0), 0});

  EXPECT_EQ(link.most_permille(0, false, seconds(1)), 1000);
  EXPECT_EQ(link.most_permille(0, false, seconds(100'000)), 1000);
}

TEST(SilentLink, LessShinesWhenNothingWasHeardForLong) {
  SilentLink link({seconds(60), 200});
  EXPECT_EQ(link.most_permille(5, false, seconds(100)), 1000);
  EXPECT_EQ(link.most_permille(5, false, seconds(159)), 1000);

  EXPECT_EQ(link.most_permille(5, false, seconds(160)), 200);
  EXPECT_EQ(link.most_permille(6, false, seconds(161)), 1000) << "somebody asks again";
  EXPECT_EQ(link.most_permille(6, false, seconds(220)), 1000);
  EXPECT_EQ(link.most_permille(6, false, seconds(221)), 200);
}

TEST(SilentLink, NeverWhileTheBoxTracks) {
  SilentLink link({seconds(60), 0});
  static_cast<void>(link.most_permille(5, true, seconds(0)));

  EXPECT_EQ(link.most_permille(5, true, seconds(3600)), 1000);
  EXPECT_EQ(link.most_permille(5, false, seconds(3601)), 0) << "the track is lost";
}

}  // namespace
}  // namespace tubesight::board
