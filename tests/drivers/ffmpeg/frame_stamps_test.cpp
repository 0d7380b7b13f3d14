#include "drivers/ffmpeg/frame_stamps.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(FrameStamps, ReadsTheThirdNumberInTheUnitTold) {
  FrameStamps stamps;

  stamps.take("#software: Lavf59\n#tb 0: 1001/30");
  stamps.take("000\n#sar 0: 1/1\n0,          7,          9,        1,      384, 0x867c9b68\n");

  ASSERT_TRUE(stamps.ready());
  const auto stamp = stamps.next();
  ASSERT_TRUE(stamp);
  EXPECT_EQ(stamp->ticks, 9);
  EXPECT_EQ(stamp->numerator, 1001);
  EXPECT_EQ(stamp->denominator, 30000);
  EXPECT_FALSE(stamps.ready());
}

TEST(FrameStamps, KeepsThePlaceOfAFrameWithoutAStamp) {
  FrameStamps stamps;

  stamps.take("#tb 0: 1/25\n0, 0, NOPTS, 1, 384, 0x1\n0, 1, -3, 1, 384, 0x1\n");

  ASSERT_TRUE(stamps.ready());
  EXPECT_FALSE(stamps.next());
  ASSERT_TRUE(stamps.ready());
  EXPECT_EQ(stamps.next()->ticks, -3);
}

TEST(FrameStamps, TakesAFrameForUnstampedWhereTheUnitIsNone) {
  FrameStamps stamps;

  stamps.take("#tb 0: 0/1\n0, 0, 5, 1, 384, 0x1\n");

  ASSERT_TRUE(stamps.ready());
  EXPECT_FALSE(stamps.next());
}

TEST(FrameStamps, WaitsForAWholeLine) {
  FrameStamps stamps;

  stamps.take("#tb 0: 1/25\n0, 0, 5, 1");

  EXPECT_FALSE(stamps.ready());
}

}  // namespace
}  // namespace tubesight::drivers
