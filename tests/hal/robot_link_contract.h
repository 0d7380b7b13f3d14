#pragma once

#include <gtest/gtest.h>

#include "hal/robot_link.h"
#include "tests/support/events.h"

namespace tubesight::support {

/// What every RobotLink promises. A maker gives a link that is not started, with a sound line to a
/// robot: `link()`, and the robot's side of it: `say(event)` sends, `replies()` and `sightings()`
/// count what it has heard. It names the tubes of a start that the line carries, kStartTubes.
template <typename Maker>
class RobotLinkContract : public testing::Test {
 protected:
  static core::Event claim_of(core::TubeAddress tube) { return tests::event_of(core::Claim{tube}); }

  Maker maker_;
  hal::RobotLink& link_ = maker_.link();
};

TYPED_TEST_SUITE_P(RobotLinkContract);

TYPED_TEST_P(RobotLinkContract, RefusesAllBeforeStart) {
  const auto polled = this->link_.poll_event();
  const auto replied = this->link_.send_reply({});
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
  core::Start start;
  for (int i = 0; i < TypeParam::kStartTubes; ++i) {
    ASSERT_TRUE(start.tubes.try_push_back({{i, -i}, {10.5 + i, 20.25}}));
  }
  core::Event claim = this->claim_of({-3, 117});
  claim.id = 4711;
  claim.at = core::FieldTime(123'456'789);
  this->maker_.say(claim);
  this->maker_.say(tests::event_of(core::LampCommand{640}));
  this->maker_.say(tests::event_of(start));
  this->maker_.say(tests::event_of(core::PoseRequest{}));
  this->maker_.say(tests::event_of(core::Pick{{320.5, 11.25}, 86}));

  core::EventList got;
  while (true) {
    const auto polled = this->link_.poll_event();
    ASSERT_TRUE(polled);
    if (!polled->has_value()) {
      break;
    }
    ASSERT_TRUE(got.try_push_back(**polled));
  }

  ASSERT_EQ(got.size(), 5);
  EXPECT_EQ(tests::content_of<core::Claim>(got[0]).tube, (core::TubeAddress{-3, 117}));
  EXPECT_EQ(got[0].id & 0xFFFFFFFF, 4711);
  EXPECT_EQ(got[0].at, core::FieldTime(123'456'789));
  EXPECT_EQ(tests::content_of<core::LampCommand>(got[1]).permille, 640);
  const auto got_start = tests::content_of<core::Start>(got[2]);
  ASSERT_EQ(got_start.tubes.size(), TypeParam::kStartTubes);
  constexpr int kLast = TypeParam::kStartTubes - 1;
  EXPECT_EQ(got_start.tubes[kLast].address, (core::TubeAddress{kLast, -kLast}));
  EXPECT_EQ(got_start.tubes[kLast].at_px, (std::array<double, 2>{10.5 + kLast, 20.25}));
  EXPECT_TRUE(tests::is<core::PoseRequest>(got[3]));
  const auto got_pick = tests::content_of<core::Pick>(got[4]);
  EXPECT_EQ(got_pick.at_px, (std::array<double, 2>{320.5, 11.25}));
  EXPECT_EQ(got_pick.seen_field, 86);
}

TYPED_TEST_P(RobotLinkContract, RepliesAndSightingsReachTheRobot) {
  ASSERT_TRUE(this->link_.start());

  this->maker_.say(this->claim_of({1, 2}));
  const auto asked = this->link_.poll_event();
  ASSERT_TRUE(asked && asked->has_value());
  core::Reply reply;
  reply.id = (*asked)->id;
  reply.content =
      core::ClaimReply{{1, 2}, core::ClaimVerdict::kUnknown, core::ClaimDoubt::kNotKnown, {}, -1};

  ASSERT_TRUE(this->link_.send_reply(reply));
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
