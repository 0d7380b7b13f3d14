#pragma once

#include <gtest/gtest.h>

#include "hal/clock.h"

namespace tubesight::support {

/// What every Clock promises. A maker gives a clock, `clock()`, and `pass()` lets some time go by:
/// for a clock that counts itself it may do nothing.
template <typename Maker>
class ClockContract : public testing::Test {
 protected:
  Maker maker_;
  const hal::Clock& clock_ = maker_.clock();
};

TYPED_TEST_SUITE_P(ClockContract);

TYPED_TEST_P(ClockContract, NeverRunsBackwards) {
  core::FieldTime last = this->clock_.now();
  for (int i = 0; i < 1000; ++i) {
    if (i % 10 == 0) {
      this->maker_.pass();
    }
    const core::FieldTime now = this->clock_.now();
    ASSERT_GE(now, last);
    last = now;
  }
}

TYPED_TEST_P(ClockContract, GoesOn) {
  const core::FieldTime before = this->clock_.now();

  // A clock that counts itself does so within as many questions.
  constexpr int kMostQuestions = 10'000'000;
  core::FieldTime after = before;
  for (int i = 0; i < kMostQuestions && after == before; ++i) {
    this->maker_.pass();
    after = this->clock_.now();
  }

  EXPECT_GT(after, before);
}

REGISTER_TYPED_TEST_SUITE_P(ClockContract, NeverRunsBackwards, GoesOn);

}  // namespace tubesight::support
