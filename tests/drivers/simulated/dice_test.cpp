#include "drivers/simulated/dice.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(Dice, AreSplitMix64) {
  // The first numbers of the authors' splitmix64.c for the state 1234567.
  Dice dice(1234567);

  EXPECT_EQ(dice.next(), 6457827717110365317U);
  EXPECT_EQ(dice.next(), 3203168211198807973U);
  EXPECT_EQ(dice.next(), 9817491932198370423U);
}

TEST(Dice, SharesLieEvenlyInTheUnitInterval) {
  Dice dice(3);
  double sum = 0.0;
  double least = 1.0;
  double most = 0.0;
  constexpr int kThrows = 10000;
  for (int i = 0; i < kThrows; ++i) {
    const double share = dice.share();
    sum += share;
    least = std::min(least, share);
    most = std::max(most, share);
  }

  EXPECT_GE(least, 0.0);
  EXPECT_LT(least, 0.001);
  EXPECT_GT(most, 0.999);
  EXPECT_LT(most, 1.0);
  EXPECT_NEAR(sum / kThrows, 0.5, 0.01);  // sigma 0.003
}

TEST(DerivedSeed, DiffersForNeighboursAndFollowsFromItsArguments) {
  EXPECT_EQ(derived_seed(1, 2), derived_seed(1, 2));
  EXPECT_NE(derived_seed(1, 2), derived_seed(1, 3));
  EXPECT_NE(derived_seed(1, 2), derived_seed(2, 2));
  EXPECT_NE(derived_seed(0, 0), 0U);
}

}  // namespace
}  // namespace tubesight::drivers
