#include "drivers/web/login_throttle.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;

TEST(LoginThrottle, LetsTheFirstAttemptsThroughAtOnce) {
  const LoginThrottle throttle;
  EXPECT_EQ(throttle.wait("10.0.0.1", seconds(5)).count(), 0);
}

TEST(LoginThrottle, DoublesTheWaitOfAnAddressUpToAMinute) {
  LoginThrottle throttle;
  LoginThrottle::Time now = seconds(100);
  for (const int expected_s : {1, 2, 4, 8, 16, 32, 60, 60}) {
    throttle.note_wrong("10.0.0.1", now);
    EXPECT_EQ(throttle.wait("10.0.0.1", now), seconds(expected_s));
    now += seconds(expected_s);
    EXPECT_EQ(throttle.wait("10.0.0.1", now).count(), 0);
  }
}

TEST(LoginThrottle, LeavesOtherAddressesAlone) {
  LoginThrottle throttle;
  throttle.note_wrong("10.0.0.1", seconds(100));
  EXPECT_EQ(throttle.wait("10.0.0.2", seconds(100)).count(), 0);
}

TEST(LoginThrottle, ForgetsAfterARightPassword) {
  LoginThrottle throttle;
  throttle.note_wrong("10.0.0.1", seconds(100));
  throttle.note_right("10.0.0.1");
  EXPECT_EQ(throttle.wait("10.0.0.1", seconds(100)).count(), 0);
}

TEST(LoginThrottle, SlowsEverybodyWhenManyAddressesGuess) {
  LoginThrottle throttle;
  for (int i = 0; i < 80; ++i) {
    throttle.note_wrong("10.0.1." + std::to_string(i), seconds(100));
  }
  EXPECT_GE(throttle.wait("10.0.0.2", seconds(100)), seconds(16));
  throttle.note_wrong("10.0.0.3", seconds(100) + minutes(20));
  EXPECT_EQ(throttle.wait("10.0.0.2", seconds(100) + minutes(20)).count(), 0);
}

}  // namespace
}  // namespace tubesight::drivers
