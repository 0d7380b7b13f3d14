#include "core/edges/dynamic_threshold.h"

#include <gtest/gtest.h>

namespace tubesight::core::edges {
namespace {

TEST(DynamicThreshold, StartsAtTheSetting) {
  EXPECT_EQ(DynamicThreshold(200).for_taps(6), 200);
  EXPECT_EQ(DynamicThreshold(420).for_taps(6), 420);
}

TEST(DynamicThreshold, CountsOperatorsByTheirTaps) {
  EXPECT_EQ(DynamicThreshold(420).for_taps(3), 210);
  EXPECT_EQ(DynamicThreshold(420).for_taps(4), 280);
}

TEST(DynamicThreshold, FollowsThreeQuartersOfTheLastGradient) {
  DynamicThreshold threshold(200);

  threshold.follow(1000, 6);
  EXPECT_EQ(threshold.for_taps(6), 750);

  // 400 of three taps are as much as 800 of six.
  threshold.follow(400, 3);
  EXPECT_EQ(threshold.for_taps(6), 600);
  EXPECT_EQ(threshold.for_taps(3), 300);
}

TEST(DynamicThreshold, HalvesDownToTheLeastOfNoise) {
  DynamicThreshold threshold(200);

  threshold.halve();
  EXPECT_EQ(threshold.for_taps(6), 100);
  EXPECT_FALSE(threshold.at_least());
  threshold.halve();
  EXPECT_EQ(threshold.for_taps(6), 50);
  threshold.halve();
  EXPECT_EQ(threshold.for_taps(6), DynamicThreshold::kLeast);
  EXPECT_TRUE(threshold.at_least());
  threshold.halve();
  EXPECT_EQ(threshold.for_taps(6), DynamicThreshold::kLeast);
}

TEST(DynamicThreshold, StaysBetweenNoiseAndTheCallersMost) {
  DynamicThreshold threshold(1);
  EXPECT_EQ(threshold.for_taps(6), DynamicThreshold::kLeast);

  threshold.follow(3060, 6, 240);
  EXPECT_EQ(threshold.for_taps(6), 240);
  threshold.follow(3060, 6);
  EXPECT_EQ(threshold.for_taps(6), 2295);
  threshold.follow(10, 6);
  EXPECT_EQ(threshold.for_taps(6), DynamicThreshold::kLeast);
}

}  // namespace
}  // namespace tubesight::core::edges
