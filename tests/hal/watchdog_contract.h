#pragma once

#include <chrono>

#include <gtest/gtest.h>

#include "hal/watchdog.h"

namespace tubesight::support {

/// What every Watchdog promises. A maker gives one that is not started, whose device obeys and
/// takes 15 s: `watchdog()`.
template <typename Maker>
class WatchdogContract : public testing::Test {
 protected:
  static constexpr std::chrono::seconds kTimeout{15};
  Maker maker_;
  hal::Watchdog& watchdog_ = maker_.watchdog();
};

TYPED_TEST_SUITE_P(WatchdogContract);

TYPED_TEST_P(WatchdogContract, IsFedBetweenStartAndStopAlone) {
  EXPECT_EQ(this->watchdog_.feed().error(), core::Error::kNotReady);
  EXPECT_EQ(this->watchdog_.timeout().count(), 0);
  ASSERT_TRUE(this->watchdog_.start(this->kTimeout));
  EXPECT_EQ(this->watchdog_.timeout(), this->kTimeout);
  EXPECT_TRUE(this->watchdog_.feed());
  EXPECT_TRUE(this->watchdog_.feed());

  this->watchdog_.stop();
  this->watchdog_.stop();

  EXPECT_EQ(this->watchdog_.feed().error(), core::Error::kNotReady);
  EXPECT_EQ(this->watchdog_.timeout().count(), 0);
}

TYPED_TEST_P(WatchdogContract, RefusesASecondStart) {
  ASSERT_TRUE(this->watchdog_.start(this->kTimeout));

  EXPECT_EQ(this->watchdog_.start(this->kTimeout).error(), core::Error::kNotReady);
  EXPECT_TRUE(this->watchdog_.feed()) << "the first start still holds";
}

TYPED_TEST_P(WatchdogContract, RefusesATimeThatIsNone) {
  EXPECT_EQ(this->watchdog_.start(std::chrono::seconds(0)).error(), core::Error::kOutOfRange);

  EXPECT_TRUE(this->watchdog_.start(this->kTimeout)) << "it may be tried again";
}

TYPED_TEST_P(WatchdogContract, StartsAgainAfterStop) {
  ASSERT_TRUE(this->watchdog_.start(this->kTimeout));
  this->watchdog_.stop();

  ASSERT_TRUE(this->watchdog_.start(this->kTimeout));
  EXPECT_TRUE(this->watchdog_.feed());
}

REGISTER_TYPED_TEST_SUITE_P(WatchdogContract, IsFedBetweenStartAndStopAlone, RefusesASecondStart,
                            RefusesATimeThatIsNone, StartsAgainAfterStop);

}  // namespace tubesight::support
