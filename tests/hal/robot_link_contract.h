#pragma once

#include <gtest/gtest.h>

#include "hal/robot_link.h"

namespace tubesight::support {

/// What every RobotLink promises. A maker gives a link that is not started, with a sound line to a
/// robot: `link()`, and the robot's side of it: `say(event)` sends, `replies()` and `sightings()`
/// count what it has heard.
template <typename Maker>
class RobotLinkContract : public testing::Test {
 protected:
  static core::Event claim_of(core::TubeAddress tube) {
    core::Event event;
    event.kind = core::EventKind::kClaim;
    event.claim = tube;
    return event;
  }
  static core::Event of_kind(core::EventKind kind) {
    core::Event event;
    event.kind = kind;
    return event;
  }

  Maker maker_;
  hal::RobotLink& link_ = maker_.link();
};

TYPED_TEST_SUITE_P(RobotLinkContract);

TYPED_TEST_P(RobotLinkContract, RefusesAllBeforeStart) {
  const auto polled = this->link_.poll_event();
  const auto replied = this->link_.send_reply({}, {});
  const auto sighted = this->link_.send_sighting({});

  ASSERT_FALSE(polled);
  EXPECT_EQ(polled.error(), core::Error::kNotReady);
  ASSERT_FALSE(replied);
  EXPECT_EQ(replied.error(), core::Error::kNotReady);
  ASSERT_FALSE(sighted);
  EXPECT_EQ(sighted.error(), core::Error::kNotReady);
}

TYPED_TEST_P(RobotLinkContract, RefusesASecondStart) {
  ASSERT_TRUE(this->link_.start());

  const auto again = this->link_.start();

  ASSERT_FALSE(again);
  EXPECT_EQ(again.error(), core::Error::kNotReady);
  EXPECT_TRUE(this->link_.poll_event()) << "the first start still holds";
}

TYPED_TEST_P(RobotLinkContract, NothingHasComeIsNoError) {
  ASSERT_TRUE(this->link_.start());

  const auto polled = this->link_.poll_event();

  ASSERT_TRUE(polled);
  EXPECT_FALSE(polled->has_value());
}

TYPED_TEST_P(RobotLinkContract, DeliversMessagesWholeAndInOrder) {
  ASSERT_TRUE(this->link_.start());
  core::Event lamp = this->of_kind(core::EventKind::kLampCommand);
  lamp.lamp_permille = 640;
  core::Event start = this->of_kind(core::EventKind::kStart);
  for (int i = 0; i < core::kMaxStartPoints; ++i) {
    ASSERT_TRUE(start.start.try_push_back({{i, -i}, {10.5 + i, 20.25}}));
  }
  this->maker_.say(this->claim_of({-3, 117}));
  this->maker_.say(lamp);
  this->maker_.say(start);
  this->maker_.say(this->of_kind(core::EventKind::kPoseRequest));

  core::EventList got;
  while (true) {
    const auto polled = this->link_.poll_event();
    ASSERT_TRUE(polled);
    if (!polled->has_value()) {
      break;
    }
    ASSERT_TRUE(got.try_push_back(**polled));
  }

  ASSERT_EQ(got.size(), 4);
  EXPECT_EQ(got[0].kind, core::EventKind::kClaim);
  EXPECT_EQ(got[0].claim, (core::TubeAddress{-3, 117}));
  EXPECT_EQ(got[1].kind, core::EventKind::kLampCommand);
  EXPECT_EQ(got[1].lamp_permille, 640);
  EXPECT_EQ(got[2].kind, core::EventKind::kStart);
  ASSERT_EQ(got[2].start.size(), core::kMaxStartPoints);
  EXPECT_EQ(got[2].start[7].address, (core::TubeAddress{7, -7}));
  EXPECT_EQ(got[2].start[7].at_px, (std::array<double, 2>{17.5, 20.25}));
  EXPECT_EQ(got[3].kind, core::EventKind::kPoseRequest);
}

TYPED_TEST_P(RobotLinkContract, RepliesAndSightingsReachTheRobot) {
  ASSERT_TRUE(this->link_.start());

  ASSERT_TRUE(this->link_.send_reply(this->claim_of({1, 2}), {}));
  ASSERT_TRUE(this->link_.send_sighting({}));
  ASSERT_TRUE(this->link_.send_sighting({}));

  EXPECT_EQ(this->maker_.replies(), 1u);
  EXPECT_EQ(this->maker_.sightings(), 2u);
}

TYPED_TEST_P(RobotLinkContract, ForgetsWhatWasNotTakenWhenStopped) {
  ASSERT_TRUE(this->link_.start());
  this->maker_.say(this->claim_of({1, 2}));
  this->link_.stop();
  this->link_.stop();
  EXPECT_FALSE(this->link_.poll_event());

  ASSERT_TRUE(this->link_.start());
  const auto polled = this->link_.poll_event();
  ASSERT_TRUE(polled);
  EXPECT_FALSE(polled->has_value());
}

REGISTER_TYPED_TEST_SUITE_P(RobotLinkContract, RefusesAllBeforeStart, RefusesASecondStart,
                            NothingHasComeIsNoError, DeliversMessagesWholeAndInOrder,
                            RepliesAndSightingsReachTheRobot, ForgetsWhatWasNotTakenWhenStopped);

}  // namespace tubesight::support
