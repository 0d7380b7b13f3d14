#pragma once

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

#include "hal/operator_station.h"
#include "tests/support/events.h"

namespace tubesight::support {

/// What every OperatorStation promises. A maker gives a station that is not started, `station()`,
/// and the operator's side of it: `say(event)` does something there, `replies()` and `pictures()`
/// count what was seen.
template <typename Maker>
class OperatorStationContract : public testing::Test {
 protected:
  static core::Event by_hand(const auto& content) {
    return tests::event_of(content, core::EventOrigin::kOperator);
  }

  /// Grey all over.
  core::RgbImageView picture() {
    pixels_.fill(90);
    return {pixels_.data(), kWidth, kHeight, 3 * kWidth};
  }

  static constexpr std::int32_t kWidth = 8;
  static constexpr std::int32_t kHeight = 4;

  Maker maker_;
  hal::OperatorStation& station_ = maker_.station();
  std::array<std::uint8_t, 3 * kWidth * kHeight> pixels_{};
};

TYPED_TEST_SUITE_P(OperatorStationContract);

TYPED_TEST_P(OperatorStationContract, RefusesAllBeforeStart) {
  const auto polled = this->station_.poll_event();
  const auto replied = this->station_.send_reply({});
  const auto shown = this->station_.show(this->picture(), {});

  ASSERT_FALSE(polled);
  EXPECT_EQ(polled.error(), core::Error::kNotReady);
  ASSERT_FALSE(replied);
  EXPECT_EQ(replied.error(), core::Error::kNotReady);
  ASSERT_FALSE(shown);
  EXPECT_EQ(shown.error(), core::Error::kNotReady);
}

TYPED_TEST_P(OperatorStationContract, RefusesASecondStart) {
  ASSERT_TRUE(this->station_.start());

  const auto again = this->station_.start();

  ASSERT_FALSE(again);
  EXPECT_EQ(again.error(), core::Error::kNotReady);
  EXPECT_TRUE(this->station_.poll_event()) << "the first start still holds";
}

TYPED_TEST_P(OperatorStationContract, NothingDoneIsNoError) {
  ASSERT_TRUE(this->station_.start());

  const auto polled = this->station_.poll_event();

  ASSERT_TRUE(polled);
  EXPECT_FALSE(polled->has_value());
}

TYPED_TEST_P(OperatorStationContract, DeliversWholeAndInOrder) {
  ASSERT_TRUE(this->station_.start());
  core::Start start{{}, 41, true};
  for (int i = 0; i < core::kMaxStartPoints; ++i) {
    ASSERT_TRUE(start.tubes.try_push_back({{i, -i}, {10.5 + i, 20.25}}));
  }
  core::Event named = this->by_hand(start);
  named.id = 77;
  named.at = core::FieldTime(123'456'789);
  this->maker_.say(this->by_hand(core::Pick{{3.5, 4.25}, 12}));
  this->maker_.say(named);
  this->maker_.say(this->by_hand(core::Acknowledge{}));
  this->maker_.say(this->by_hand(core::LampCommand{640}));

  core::EventList got;
  while (true) {
    const auto polled = this->station_.poll_event();
    ASSERT_TRUE(polled);
    if (!polled->has_value()) {
      break;
    }
    ASSERT_TRUE(got.try_push_back(**polled));
  }

  ASSERT_EQ(got.size(), 4);
  for (const core::Event& event : got) {
    EXPECT_EQ(event.origin, core::EventOrigin::kOperator);
  }
  const auto pick = tests::content_of<core::Pick>(got[0]);
  EXPECT_EQ(pick.at_px, (std::array<double, 2>{3.5, 4.25}));
  EXPECT_EQ(pick.seen_field, 12);
  EXPECT_EQ(got[1].id, 77);
  EXPECT_EQ(got[1].at, core::FieldTime(123'456'789));
  const auto arrived = tests::content_of<core::Start>(got[1]);
  ASSERT_EQ(arrived.tubes.size(), core::kMaxStartPoints);
  EXPECT_EQ(arrived.tubes[7].address, (core::TubeAddress{7, -7}));
  EXPECT_EQ(arrived.tubes[7].at_px, (std::array<double, 2>{17.5, 20.25}));
  EXPECT_EQ(arrived.seen_field, 41);
  EXPECT_TRUE(arrived.confirmed);
  EXPECT_TRUE(tests::is<core::Acknowledge>(got[2]));
  EXPECT_EQ(tests::content_of<core::LampCommand>(got[3]).permille, 640);
}

TYPED_TEST_P(OperatorStationContract, RepliesAndPicturesAreSeen) {
  ASSERT_TRUE(this->station_.start());

  ASSERT_TRUE(this->station_.send_reply({}));
  ASSERT_TRUE(this->station_.show(this->picture(), {}));
  ASSERT_TRUE(this->station_.show(this->picture(), {}));

  EXPECT_EQ(this->maker_.replies(), 1U);
  EXPECT_EQ(this->maker_.pictures(), 2U);
}

TYPED_TEST_P(OperatorStationContract, ForgetsWhatWasNotTakenWhenStopped) {
  ASSERT_TRUE(this->station_.start());
  this->maker_.say(this->by_hand(core::Acknowledge{}));
  this->station_.stop();
  this->station_.stop();
  EXPECT_FALSE(this->station_.poll_event());

  ASSERT_TRUE(this->station_.start());
  const auto polled = this->station_.poll_event();
  ASSERT_TRUE(polled);
  EXPECT_FALSE(polled->has_value());
}

REGISTER_TYPED_TEST_SUITE_P(OperatorStationContract, RefusesAllBeforeStart, RefusesASecondStart,
                            NothingDoneIsNoError, DeliversWholeAndInOrder,
                            RepliesAndPicturesAreSeen, ForgetsWhatWasNotTakenWhenStopped);

}  // namespace tubesight::support
