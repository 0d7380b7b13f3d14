// The way of a camera's packets.

#include <chrono>

#include <gtest/gtest.h>

#include "tests/drivers/aravis/gige_bench.h"

namespace tubesight::tests {
namespace {

using core::FieldStatus;
using drivers::AravisTrouble;
using std::chrono::seconds;

// A switch in the middle of a mission that takes smaller packets alone.
TEST(GigePath, ThatBecomesNarrowIsFoundAndGoneByWithSmallPackets) {
  GigeBench bench;
  ASSERT_TRUE(bench.settle()) << bench.message();
  const core::FieldTime begin = bench.library().now();
  bench.camera().path = 1500;
  while (bench.next_status() == FieldStatus::kDamaged) {
    ASSERT_LT(bench.library().now() - begin, seconds(6));
  }
  EXPECT_EQ(bench.report().trouble, AravisTrouble::kIncomplete);
  bench.camera().negotiated_packet = 1500;  // the question goes the same way

  ASSERT_TRUE(bench.start_anew()) << bench.message();
  EXPECT_TRUE(bench.good_within(4));
  EXPECT_EQ(bench.report().trouble, AravisTrouble::kNone);
  EXPECT_EQ(bench.camera().packet, 1500);
}

}  // namespace
}  // namespace tubesight::tests
