#include "drivers/aravis/frame_counter.h"

#include <gtest/gtest.h>

namespace tubesight::tests {
namespace {

using drivers::aravis::FrameCounter;

TEST(FrameCounter, CountsFromWhereverTheCameraBegins) {
  FrameCounter counter;
  EXPECT_EQ(counter.next(501).sequence, 0);
  EXPECT_EQ(counter.next(502).sequence, 1);
  EXPECT_TRUE(counter.counts());
}

TEST(FrameCounter, AGapIsLostFrames) {
  FrameCounter counter;
  static_cast<void>(counter.next(10));
  const auto step = counter.next(14);

  EXPECT_EQ(step.sequence, 4);
  EXPECT_EQ(step.lost, 3);
}

TEST(FrameCounter, SixteenBitsBeginAnewAtOne) {
  FrameCounter counter;
  static_cast<void>(counter.next(65'534));
  EXPECT_EQ(counter.next(65'535).lost, 0);
  const auto step = counter.next(1);

  EXPECT_EQ(step.sequence, 2);
  EXPECT_EQ(step.lost, 0);
  EXPECT_FALSE(step.went_back);
}

TEST(FrameCounter, FramesLostOverTheWrapAreCounted) {
  FrameCounter counter;
  static_cast<void>(counter.next(65'530));
  EXPECT_EQ(counter.next(3).lost, 7);
}

TEST(FrameCounter, SixtyFourBitsGoOnBeyond) {
  FrameCounter counter;
  static_cast<void>(counter.next(65'535));
  EXPECT_EQ(counter.next(65'536).lost, 0);
  EXPECT_EQ(counter.next(65'537).sequence, 2);
}

TEST(FrameCounter, AWayBackIsAGapThatNoTrackGoesOnOver) {
  FrameCounter counter;
  static_cast<void>(counter.next(1000));
  const auto step = counter.next(3);

  EXPECT_TRUE(step.went_back);
  EXPECT_EQ(step.lost, 0);
  EXPECT_EQ(step.sequence, FrameCounter::kNewBeginning);
}

TEST(FrameCounter, AGiantLeapIsAnotherCounter) {
  FrameCounter counter;
  static_cast<void>(counter.next(1));
  EXPECT_TRUE(counter.next(1'000'000).went_back);
}

TEST(FrameCounter, OneThatStandsStillDoesNotCount) {
  FrameCounter counter;
  static_cast<void>(counter.next(0));
  const auto step = counter.next(0);

  EXPECT_FALSE(step.repeated);
  EXPECT_EQ(step.sequence, 1);
  EXPECT_FALSE(counter.counts());
}

TEST(FrameCounter, OneThatCountedAndStandsStillRepeats) {
  FrameCounter counter;
  static_cast<void>(counter.next(1));
  static_cast<void>(counter.next(2));
  EXPECT_TRUE(counter.next(2).repeated);
}

TEST(FrameCounter, NumbersGoOnOverANewBeginning) {
  FrameCounter counter;
  static_cast<void>(counter.next(40));
  counter.begin_anew();
  EXPECT_EQ(counter.next(1).sequence, FrameCounter::kNewBeginning);
}

}  // namespace
}  // namespace tubesight::tests
