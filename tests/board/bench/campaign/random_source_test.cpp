#include "board/bench/campaign/random_source.h"

#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace tubesight::board::campaign {
namespace {

TEST(RandomSource, RepeatsItselfAndNothingElse) {
  RandomSource one(7, 12, 3);
  RandomSource again(7, 12, 3);
  std::set<std::uint64_t> seen;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t bits = one.bits();
    EXPECT_EQ(bits, again.bits());
    seen.insert(bits);
  }
  for (const auto& [seed, move, topic] :
       {std::tuple{8, 12, 3}, {7, 13, 3}, {7, 12, 4}, {12, 7, 3}}) {
    RandomSource other(static_cast<std::uint64_t>(seed), move, static_cast<std::uint64_t>(topic));
    for (int i = 0; i < 100; ++i) {
      EXPECT_TRUE(seen.insert(other.bits()).second) << seed << ":" << move << ":" << topic;
    }
  }
}

TEST(RandomSource, IsEvenOverItsRange) {
  constexpr int kDraws = 20'000;
  double sum = 0.0;
  double squares = 0.0;
  std::array<int, 5> faces{};
  int heads = 0;
  RandomSource random(1, 0, 0);
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.between(-2.0, 4.0);
    ASSERT_GE(x, -2.0);
    ASSERT_LT(x, 4.0);
    sum += x;
    squares += x * x;
    ++faces.at(static_cast<std::size_t>(random.whole(3, 7) - 3));
    heads += random.chance(0.25) ? 1 : 0;
  }
  // Mean 1, variance 36 / 12 = 3; four standard errors.
  EXPECT_NEAR(sum / kDraws, 1.0, 4.0 * std::sqrt(3.0 / kDraws));
  EXPECT_NEAR(squares / kDraws, 4.0, 0.15);
  for (const int count : faces) {
    EXPECT_NEAR(count, kDraws / 5, 4.0 * std::sqrt(kDraws * 0.16));
  }
  EXPECT_NEAR(heads, kDraws / 4, 4.0 * std::sqrt(kDraws * 0.1875));
}

TEST(RandomSource, DrawsNormallyWithinThreeDeviations) {
  constexpr int kDraws = 20'000;
  RandomSource random(2, 5, 1);
  double squares = 0.0;
  int within_one = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal(0.5);
    ASSERT_LE(std::abs(x), 1.5);
    squares += x * x;
    within_one += std::abs(x) < 0.5 ? 1 : 0;
  }
  EXPECT_NEAR(within_one, 0.6845 * kDraws, 4.0 * std::sqrt(kDraws * 0.216));
  EXPECT_NEAR(std::sqrt(squares / kDraws), 0.4933, 0.01);  // cut off at three: 0.9866
}

}  // namespace
}  // namespace tubesight::board::campaign
