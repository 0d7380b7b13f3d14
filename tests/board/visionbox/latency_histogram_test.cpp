#include "board/visionbox/latency_histogram.h"

#include <chrono>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using std::chrono::microseconds;

TEST(LatencyHistogram, IsZeroBeforeTheFirst) {
  const LatencyHistogram histogram;

  EXPECT_EQ(histogram.count(), 0);
  EXPECT_EQ(histogram.worst_us(), 0);
  EXPECT_EQ(histogram.quantile_us(0.5), 0);
}

TEST(LatencyHistogram, TellsOneValueWithinAnEighth) {
  for (const int us : {0, 1, 7, 8, 15, 16, 17, 100, 999, 1000, 12'345, 1'000'000}) {
    LatencyHistogram histogram;
    histogram.add(microseconds(us));

    EXPECT_EQ(histogram.worst_us(), us);
    EXPECT_EQ(histogram.quantile_us(0.5), us) << "the worst bounds its bin";
  }
}

TEST(LatencyHistogram, QuantilesLieInTheirBins) {
  LatencyHistogram histogram;
  for (int us = 1; us <= 1000; ++us) {
    histogram.add(microseconds(us));
  }

  EXPECT_EQ(histogram.count(), 1000);
  EXPECT_GE(histogram.quantile_us(0.5), 500);
  EXPECT_LE(histogram.quantile_us(0.5), 563);
  EXPECT_GE(histogram.quantile_us(0.99), 990);
  EXPECT_EQ(histogram.quantile_us(1.0), 1000);
}

TEST(LatencyHistogram, TakesWhatIsBeyondReason) {
  LatencyHistogram histogram;
  histogram.add(std::chrono::nanoseconds(-5));
  histogram.add(std::chrono::hours(1000));

  EXPECT_EQ(histogram.count(), 2);
  EXPECT_EQ(histogram.worst_us(), (1 << 30) - 1);
}

}  // namespace
}  // namespace tubesight::board
