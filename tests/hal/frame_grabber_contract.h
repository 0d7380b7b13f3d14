#pragma once

#include <chrono>
#include <utility>

#include <gtest/gtest.h>

#include "hal/frame_grabber.h"

namespace tubesight::support {

/// What every FrameGrabber promises. A maker gives a grabber that is not started and will deliver
/// at least three good fields: `grabber()`.
template <typename Maker>
class FrameGrabberContract : public testing::Test {
 protected:
  static constexpr std::chrono::milliseconds kTimeout{1000};
  Maker maker_;
  hal::FrameGrabber& grabber_ = maker_.grabber();
};

TYPED_TEST_SUITE_P(FrameGrabberContract);

TYPED_TEST_P(FrameGrabberContract, RefusesToGrabBeforeStart) {
  const auto lease = this->grabber_.grab_for(this->kTimeout);

  ASSERT_FALSE(lease);
  EXPECT_EQ(lease.error(), core::Error::kNotReady);
}

TYPED_TEST_P(FrameGrabberContract, RefusesASecondStart) {
  ASSERT_TRUE(this->grabber_.start());

  const auto again = this->grabber_.start();

  ASSERT_FALSE(again);
  EXPECT_EQ(again.error(), core::Error::kNotReady);
  EXPECT_TRUE(this->grabber_.grab_for(this->kTimeout)) << "the first start still holds";
}

TYPED_TEST_P(FrameGrabberContract, LendsOneFieldAtATime) {
  ASSERT_TRUE(this->grabber_.start());
  auto lease = this->grabber_.grab_for(this->kTimeout);
  ASSERT_TRUE(lease);

  const auto second = this->grabber_.grab_for(this->kTimeout);

  ASSERT_FALSE(second);
  EXPECT_EQ(second.error(), core::Error::kNotReady);
}

TYPED_TEST_P(FrameGrabberContract, AMovedLeaseGivesBackOnce) {
  ASSERT_TRUE(this->grabber_.start());
  {
    auto lease = this->grabber_.grab_for(this->kTimeout);
    ASSERT_TRUE(lease);
    const hal::FieldLease kept = *std::move(lease);
    EXPECT_FALSE(this->grabber_.grab_for(this->kTimeout)) << "the moved lease is alive";
  }

  EXPECT_TRUE(this->grabber_.grab_for(this->kTimeout));
}

TYPED_TEST_P(FrameGrabberContract, FieldsComeInTheOrderOfTheirExposure) {
  ASSERT_TRUE(this->grabber_.start());
  core::Field before;
  for (int i = 0; i < 3; ++i) {
    const auto lease = this->grabber_.grab_for(this->kTimeout);
    ASSERT_TRUE(lease);
    const core::Field& field = lease->field();
    ASSERT_NE(field.pixels.pixels, nullptr);
    EXPECT_GT(field.pixels.width_px, 0);
    EXPECT_GT(field.pixels.lines, 0);
    EXPECT_GE(field.pixels.stride_px, field.pixels.width_px);
    if (i > 0) {
      EXPECT_GT(field.sequence, before.sequence);
      EXPECT_GT(field.mid_exposure, before.mid_exposure);
    }
    before = field;
  }
}

TYPED_TEST_P(FrameGrabberContract, RefusesToGrabAfterStop) {
  ASSERT_TRUE(this->grabber_.start());
  this->grabber_.stop();
  this->grabber_.stop();

  const auto lease = this->grabber_.grab_for(this->kTimeout);

  ASSERT_FALSE(lease);
  EXPECT_EQ(lease.error(), core::Error::kNotReady);
}

REGISTER_TYPED_TEST_SUITE_P(FrameGrabberContract, RefusesToGrabBeforeStart, RefusesASecondStart,
                            LendsOneFieldAtATime, AMovedLeaseGivesBackOnce,
                            FieldsComeInTheOrderOfTheirExposure, RefusesToGrabAfterStop);

}  // namespace tubesight::support
