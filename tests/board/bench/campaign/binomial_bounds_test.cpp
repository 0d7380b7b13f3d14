#include "board/bench/campaign/binomial_bounds.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tubesight::board::campaign {
namespace {

// Tables of exact 95 % intervals: Documenta Geigy (1970), binomial confidence limits.
TEST(BinomialBounds, AgreesWithPrintedTables) {
  const BinomialBounds four_of_twenty = binomial_bounds(4, 20);
  EXPECT_NEAR(four_of_twenty.lower, 0.0573, 5e-5);
  EXPECT_NEAR(four_of_twenty.upper, 0.4366, 5e-5);
  const BinomialBounds one_of_ten = binomial_bounds(1, 10);
  EXPECT_NEAR(one_of_ten.lower, 0.0025, 5e-5);
  EXPECT_NEAR(one_of_ten.upper, 0.4450, 5e-5);
  const BinomialBounds half = binomial_bounds(5, 10);
  EXPECT_NEAR(half.lower, 0.1871, 5e-5);
  EXPECT_NEAR(half.upper, 0.8129, 5e-5);
}

TEST(BinomialBounds, HasAClosedFormWithoutEvents) {
  // Nothing in n trials: 1 - 0.025^(1/n).
  for (const std::int64_t trials : {std::int64_t{1}, std::int64_t{96}, std::int64_t{14'000}}) {
    const BinomialBounds bounds = binomial_bounds(0, trials);
    const double upper = 1.0 - std::pow(0.025, 1.0 / static_cast<double>(trials));
    EXPECT_EQ(bounds.lower, 0.0);
    EXPECT_NEAR(bounds.upper, upper, 1e-9 + 1e-6 * upper) << trials;
    const BinomialBounds all = binomial_bounds(trials, trials);
    EXPECT_EQ(all.upper, 1.0);
    EXPECT_NEAR(all.lower, 1.0 - upper, 1e-6) << trials;
  }
}

TEST(BinomialBounds, SaysNothingWithoutTrials) {
  const BinomialBounds bounds = binomial_bounds(0, 0);
  EXPECT_EQ(bounds.lower, 0.0);
  EXPECT_EQ(bounds.upper, 1.0);
}

TEST(BinomialBounds, StandsLargeCounts) {
  // Near the normal approximation: p = 0.1, sigma = sqrt(0.09 / n) = 0.0003.
  const BinomialBounds bounds = binomial_bounds(100'000, 1'000'000);
  EXPECT_NEAR(bounds.lower, 0.1 - 1.96 * 0.0003, 2e-6);
  EXPECT_NEAR(bounds.upper, 0.1 + 1.96 * 0.0003, 2e-6);
}

}  // namespace
}  // namespace tubesight::board::campaign
