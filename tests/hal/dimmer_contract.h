#pragma once

#include <cstdint>

#include <gtest/gtest.h>

#include "hal/dimmer.h"

namespace tubesight::support {

/// What every Dimmer promises. A maker gives a dimmer that is not started, whose device obeys:
/// `dimmer()`.
template <typename Maker>
class DimmerContract : public testing::Test {
 protected:
  Maker maker_;
  hal::Dimmer& dimmer_ = maker_.dimmer();
};

TYPED_TEST_SUITE_P(DimmerContract);

TYPED_TEST_P(DimmerContract, RefusesLevelsBeforeStart) {
  const auto set = this->dimmer_.set_level(500);

  ASSERT_FALSE(set);
  EXPECT_EQ(set.error(), core::Error::kNotReady);
  EXPECT_EQ(this->dimmer_.level_permille(), 0);
}

TYPED_TEST_P(DimmerContract, RefusesASecondStart) {
  ASSERT_TRUE(this->dimmer_.start());
  ASSERT_TRUE(this->dimmer_.set_level(500));

  const auto again = this->dimmer_.start();

  ASSERT_FALSE(again);
  EXPECT_EQ(again.error(), core::Error::kNotReady);
  EXPECT_EQ(this->dimmer_.level_permille(), 500) << "the first start still holds";
}

TYPED_TEST_P(DimmerContract, IsDarkUntilALevelIsSet) {
  ASSERT_TRUE(this->dimmer_.start());

  EXPECT_EQ(this->dimmer_.level_permille(), 0);
}

TYPED_TEST_P(DimmerContract, TakesEveryLevelFromDarkToFull) {
  ASSERT_TRUE(this->dimmer_.start());
  for (const std::int32_t level : {0, 1, 500, 500, 999, 1000, 0}) {
    ASSERT_TRUE(this->dimmer_.set_level(level)) << level;
    EXPECT_EQ(this->dimmer_.level_permille(), level);
  }
}

TYPED_TEST_P(DimmerContract, RefusesLevelsBeyondAndKeepsTheOneBefore) {
  ASSERT_TRUE(this->dimmer_.start());
  ASSERT_TRUE(this->dimmer_.set_level(300));
  for (const std::int32_t level : {-1, 1001, INT32_MIN, INT32_MAX}) {
    const auto set = this->dimmer_.set_level(level);

    ASSERT_FALSE(set) << level;
    EXPECT_EQ(set.error(), core::Error::kOutOfRange);
    EXPECT_EQ(this->dimmer_.level_permille(), 300);
  }
}

TYPED_TEST_P(DimmerContract, IsDarkAndRefusesLevelsAfterStop) {
  ASSERT_TRUE(this->dimmer_.start());
  ASSERT_TRUE(this->dimmer_.set_level(700));
  this->dimmer_.stop();
  this->dimmer_.stop();

  const auto set = this->dimmer_.set_level(500);

  ASSERT_FALSE(set);
  EXPECT_EQ(set.error(), core::Error::kNotReady);
  EXPECT_EQ(this->dimmer_.level_permille(), 0);
}

TYPED_TEST_P(DimmerContract, StartsAgainAfterStop) {
  ASSERT_TRUE(this->dimmer_.start());
  this->dimmer_.stop();

  ASSERT_TRUE(this->dimmer_.start());
  EXPECT_TRUE(this->dimmer_.set_level(1000));
}

REGISTER_TYPED_TEST_SUITE_P(DimmerContract, RefusesLevelsBeforeStart, RefusesASecondStart,
                            IsDarkUntilALevelIsSet, TakesEveryLevelFromDarkToFull,
                            RefusesLevelsBeyondAndKeepsTheOneBefore,
                            IsDarkAndRefusesLevelsAfterStop, StartsAgainAfterStop);

}  // namespace tubesight::support
