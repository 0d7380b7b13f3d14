#include "board/box/journal_desk.h"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/events.h"

namespace tubesight::board {
namespace {

using Kind = JournalNote::Kind;
constexpr std::int32_t kWidth = 4;
constexpr std::int32_t kHeight = 2;
constexpr core::TubeAddress kTube{40, 61};

class JournalDeskTest : public ::testing::Test {
 protected:
  /// A step with a picture whose pixels are its number.
  void step() {
    ++number_;
    pixels_.assign(std::size_t{kWidth} * kHeight, static_cast<std::uint8_t>(number_));
    input_->field.number = number_;
    input_->field.mid_exposure = std::chrono::milliseconds(20 * number_);
    input_->field.pixels = {pixels_.data(), kWidth, kHeight, kWidth, 0, 1};
    output_->sighting.field = number_;
    output_->sighting.time = input_->field.mid_exposure;
    desk_.take(*input_, *output_);
    input_->events.clear();
    output_->replies.clear();
  }
  void claim(std::int64_t id, core::FieldTime at) {
    core::Event event = tests::event_of(core::Claim{kTube});
    event.id = id;
    event.at = at;
    ASSERT_TRUE(input_->events.try_push_back(event));
  }
  void answer(std::int64_t id, std::int64_t judged_by) {
    core::ClaimReply reply;
    reply.claimed = kTube;
    reply.tube = kTube;
    reply.verdict = core::ClaimVerdict::kConfirmed;
    reply.field = judged_by;
    ASSERT_TRUE(output_->replies.try_push_back(
        {id, core::EventOrigin::kRobot, input_->field.mid_exposure, reply}));
  }
  [[nodiscard]] JournalNote next() {
    JournalNote note;
    EXPECT_TRUE(desk_.take_note(note));
    return note;
  }
  [[nodiscard]] bool has_more() {
    JournalNote note;
    return desk_.take_note(note);
  }

  JournalDesk desk_{kWidth, kHeight};
  std::unique_ptr<core::session::Input> input_ = std::make_unique<core::session::Input>();
  std::unique_ptr<core::session::Output> output_ = std::make_unique<core::session::Output>();
  std::vector<std::uint8_t> pixels_;
  std::int64_t number_ = 0;
};

TEST_F(JournalDeskTest, AClaimComesWithItsInstantAndWhatItWasJudgedBy) {
  output_->sighting.offset_um_q8 = 256;
  step();
  output_->sighting.offset_um_q8 = 512;
  claim(7, std::chrono::milliseconds(23));
  answer(7, 1);  // by the field before, which is nearer
  step();

  JournalNote note = next();
  EXPECT_EQ(note.kind, Kind::kClaim);
  EXPECT_EQ(note.id, 7);
  EXPECT_EQ(note.at, std::chrono::milliseconds(23));
  EXPECT_EQ(note.seen.field, 1);
  EXPECT_EQ(note.seen.offset_um_q8, 256);
  const JournalDesk::Picture* const picture = desk_.picture(note);
  ASSERT_NE(picture, nullptr);
  EXPECT_EQ(picture->field.number, 1);
  EXPECT_EQ(picture->field.pixels.pixels[kWidth], 1);
  desk_.give_back(note);
  EXPECT_EQ(desk_.picture(note), nullptr);
  EXPECT_FALSE(has_more());
}

TEST_F(JournalDeskTest, AClaimJudgedByAnOldFieldHasNoPicture) {
  for (int i = 0; i < 4; ++i) {
    step();
  }
  answer(7, 1);
  step();

  const JournalNote note = next();
  EXPECT_TRUE(note.seen_known);
  EXPECT_EQ(desk_.picture(note), nullptr);
}

TEST_F(JournalDeskTest, ALossIsToldOnceAndWithItsReason) {
  output_->sighting.state = core::TrackState::kTracking;
  step();
  output_->sighting.state = core::TrackState::kLost;
  output_->sighting.reason = core::Reason::kJump;
  step();
  step();

  const JournalNote note = next();
  EXPECT_EQ(note.kind, Kind::kLoss);
  EXPECT_EQ(note.seen.reason, core::Reason::kJump);
  EXPECT_NE(desk_.picture(note), nullptr);
  EXPECT_FALSE(has_more());
}

TEST_F(JournalDeskTest, ATubeLeftIsToldWhereItWasClaimed) {
  output_->sighting.tool_known = true;
  output_->sighting.tool = {1, 1};
  step();
  output_->sighting.tool = {1, 2};
  step();
  EXPECT_FALSE(has_more()) << "nobody had claimed anything";
  answer(1, 2);
  step();
  output_->sighting.tool = {1, 3};
  step();

  EXPECT_EQ(next().kind, Kind::kClaim);
  EXPECT_EQ(next().kind, Kind::kLeft);
}

TEST_F(JournalDeskTest, AStartComesWithItsClicks) {
  core::Start start;
  ASSERT_TRUE(start.tubes.try_push_back({kTube, {3.0, 4.0}}));
  core::Event event = tests::event_of(start, core::EventOrigin::kOperator);
  event.id = 9;
  ASSERT_TRUE(input_->events.try_push_back(event));
  ASSERT_TRUE(
      output_->replies.try_push_back({9, core::EventOrigin::kOperator, {}, core::StartReply{}}));
  step();

  const JournalNote note = next();
  EXPECT_EQ(note.kind, Kind::kStart);
  ASSERT_EQ(note.start.tubes.size(), 1);
  EXPECT_EQ(note.start.tubes[0].address, kTube);
}

TEST_F(JournalDeskTest, WhatFindsNoRoomIsCountedAndTheCountComesThrough) {
  for (std::int64_t id = 0; id < 70; ++id) {
    answer(id, 1);
    step();
  }
  EXPECT_EQ(desk_.lost(), 6);
  std::int64_t pictures = 0;
  for (int i = 0; i < 64; ++i) {
    JournalNote note = next();
    pictures += desk_.picture(note) != nullptr ? 1 : 0;
  }
  EXPECT_LE(pictures, 4) << "there are no more places";
  EXPECT_FALSE(has_more());

  answer(71, 1);
  step();

  const JournalNote gap = next();
  EXPECT_EQ(gap.kind, Kind::kGap);
  EXPECT_EQ(gap.lost, 6);
  EXPECT_EQ(next().id, 71);
}

TEST_F(JournalDeskTest, AFieldLargerThanSaidIsNotCopied) {
  JournalDesk small(2, 2);
  std::vector<std::uint8_t> pixels(64);
  input_->field.pixels = {pixels.data(), 8, 8, 8, 0, 1};
  output_->sighting.state = core::TrackState::kLost;
  small.take(*input_, *output_);
  JournalNote note;
  ASSERT_TRUE(small.take_note(note));
  EXPECT_EQ(small.picture(note), nullptr);
}

}  // namespace
}  // namespace tubesight::board
