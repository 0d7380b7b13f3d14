#include "board/visionbox/lamp_ramp.h"

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(LampRamp, LeadsTheLevelInTheTimeOfItsSoftStart) {
  LampRamp ramp({milliseconds(500), seconds(0), 1000});
  ramp.begin(seconds(5));

  EXPECT_EQ(ramp.next(1000, seconds(5)), 0);
  EXPECT_EQ(ramp.next(1000, seconds(5) + milliseconds(100)), 200);
  EXPECT_EQ(ramp.next(1000, seconds(5) + milliseconds(499)), 998);
  EXPECT_EQ(ramp.next(1000, seconds(5) + milliseconds(600)), 1000);
  EXPECT_EQ(ramp.next(900, seconds(5) + milliseconds(610)), 980) << "and back";
  EXPECT_EQ(ramp.next(900, seconds(6)), 900);
}

TEST(LampRamp, WithoutASoftStartTheLevelIsThereAtOnce) {
  LampRamp ramp({milliseconds(0), seconds(0), 1000});
  ramp.begin(seconds(5));

  EXPECT_EQ(ramp.next(700, seconds(5)), 700);
  EXPECT_EQ(ramp.next(0, seconds(5)), 0);
}

TEST(LampRamp, FullPowerEndsWhenItsTimeIsUsedUp) {
  LampRamp ramp({milliseconds(0), seconds(10), 600});
  ramp.begin(seconds(0));
  EXPECT_EQ(ramp.next(1000, seconds(0)), 1000);

  EXPECT_EQ(ramp.next(1000, seconds(9)), 1000);
  EXPECT_FALSE(ramp.resting());
  EXPECT_EQ(ramp.next(1000, seconds(10)), 600);
  EXPECT_TRUE(ramp.resting());
  EXPECT_EQ(ramp.next(500, seconds(11)), 500) << "less is allowed";
  EXPECT_EQ(ramp.next(1000, seconds(19)), 600) << "the rest is not over";
  EXPECT_EQ(ramp.next(1000, seconds(20)), 1000);
}

TEST(LampRamp, ShortTimesAtFullPowerAddUp) {
  LampRamp ramp({milliseconds(0), seconds(10), 600});
  ramp.begin(seconds(0));
  int second = 0;
  for (int round = 0; round < 5; ++round) {  // 4 s of light, 2 s of rest
    for (int i = 0; i < 4; ++i) {
      ramp.next(1000, seconds(second++));
    }
    for (int i = 0; i < 2; ++i) {
      ramp.next(600, seconds(second++));
    }
  }

  EXPECT_TRUE(ramp.resting());
}

TEST(LampRamp, AtOrBelowTheRestNothingIsCounted) {
  LampRamp ramp({milliseconds(0), seconds(10), 600});
  ramp.begin(seconds(0));

  EXPECT_EQ(ramp.next(600, seconds(0)), 600);
  EXPECT_EQ(ramp.next(600, seconds(1000)), 600);
  EXPECT_EQ(ramp.next(1000, seconds(1000)), 1000);
}

}  // namespace
}  // namespace tubesight::board
