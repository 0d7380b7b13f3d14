#include "board/box/overlay_news.h"

#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using core::overlay::ClickVerdict;

core::Start three_clicks() {
  core::Start start;
  for (std::int32_t i = 0; i < 3; ++i) {
    static_cast<void>(start.tubes.try_push_back({{40 + i, 60}, {100.5 + i, 200.25}}));
  }
  return start;
}

class OverlayNewsTest : public testing::Test {
 protected:
  /// A step at this time.
  void step(double time_s, core::TrackState state = core::TrackState::kTracking) {
    output_->sighting.time =
        std::chrono::duration_cast<core::FieldTime>(std::chrono::duration<double>(time_s));
    output_->sighting.state = state;
    news_.take(*input_, *output_);
    input_->events.clear();
    output_->replies.clear();
  }

  void start_with(core::StartReply answer, core::Start start = three_clicks()) {
    core::Event event;
    event.id = 7;
    event.origin = core::EventOrigin::kOperator;
    event.content = start;
    ASSERT_TRUE(input_->events.try_push_back(event));
    core::Reply reply;
    reply.id = 7;
    reply.origin = core::EventOrigin::kOperator;
    reply.content = answer;
    ASSERT_TRUE(output_->replies.try_push_back(reply));
  }

  void claim_with(core::ClaimVerdict verdict) {
    core::Reply reply;
    reply.content = core::ClaimReply{{40, 61}, verdict, core::ClaimDoubt::kNone, {40, 60}, 3};
    ASSERT_TRUE(output_->replies.try_push_back(reply));
  }

  OverlayNews news_;
  std::unique_ptr<core::session::Input> input_ = std::make_unique<core::session::Input>();
  std::unique_ptr<core::session::Output> output_ = std::make_unique<core::session::Output>();
};

TEST_F(OverlayNewsTest, ShowsClicksThatWereTakenForThreeSeconds) {
  start_with({});
  step(10.0);

  ASSERT_EQ(news_.clicks().size(), 3);
  EXPECT_EQ(news_.clicks()[1].address, (core::TubeAddress{41, 60}));
  EXPECT_EQ(news_.clicks()[1].at_px.u_q16, 101 * 65'536 + 32'768);
  EXPECT_EQ(news_.clicks()[1].at_px.v_q16, 200 * 65'536 + 16'384);
  EXPECT_EQ(news_.clicks()[1].verdict, ClickVerdict::kTaken);
  step(12.9);
  EXPECT_EQ(news_.clicks().size(), 3);
  step(13.1);
  EXPECT_EQ(news_.clicks().size(), 0);
}

TEST_F(OverlayNewsTest, TakesClicksAwayWhenTheToolLeavesThePlaceClicked) {
  start_with({core::StartRefusal::kElsewhere, 0});
  output_->sighting.velocity_known = true;
  output_->sighting.velocity_um_s = {0, -9'000};
  step(10.0);
  EXPECT_EQ(news_.clicks().size(), 3);

  output_->sighting.velocity_um_s = {0, -11'000};
  step(10.1);
  EXPECT_EQ(news_.clicks().size(), 0);
  EXPECT_EQ(news_.refusal(), core::StartRefusal::kElsewhere);
}

TEST_F(OverlayNewsTest, KeepsARefusedStartUntilTheNextOne) {
  start_with({core::StartRefusal::kNoTubeThere, 2});
  step(10.0, core::TrackState::kWaiting);
  step(500.0, core::TrackState::kWaiting);

  EXPECT_EQ(news_.refusal(), core::StartRefusal::kNoTubeThere);
  ASSERT_EQ(news_.clicks().size(), 3);
  EXPECT_EQ(news_.clicks()[1].verdict, ClickVerdict::kRefused);
  EXPECT_EQ(news_.clicks()[2].verdict, ClickVerdict::kBlamed);

  start_with({});
  step(501.0);
  EXPECT_EQ(news_.refusal(), core::StartRefusal::kNone);
  EXPECT_EQ(news_.clicks()[2].verdict, ClickVerdict::kTaken);
}

TEST_F(OverlayNewsTest, ForgetsARefusedStartWhileItTracks) {
  start_with({core::StartRefusal::kElsewhere, -1});
  step(10.0);
  EXPECT_EQ(news_.clicks()[0].verdict, ClickVerdict::kRefused);

  step(13.1);
  EXPECT_EQ(news_.clicks().size(), 0);
  EXPECT_EQ(news_.refusal(), core::StartRefusal::kNone);
}

TEST_F(OverlayNewsTest, ShowsAContradictedClaimUntilTheNextAnswerOrTheOperatorAcknowledges) {
  claim_with(core::ClaimVerdict::kContradicted);
  step(10.0);
  step(1000.0);
  ASSERT_TRUE(news_.claim().has_value());
  EXPECT_EQ(news_.claim()->verdict, core::ClaimVerdict::kContradicted);

  output_->sighting.tool_known = true;
  output_->sighting.tool = {40, 61};
  claim_with(core::ClaimVerdict::kConfirmed);
  step(1001.0);
  EXPECT_EQ(news_.claim()->verdict, core::ClaimVerdict::kConfirmed);
  step(1004.1);
  EXPECT_FALSE(news_.claim().has_value());

  claim_with(core::ClaimVerdict::kContradicted);
  step(1005.0);
  core::Event seen;
  seen.content = core::Acknowledge{};
  ASSERT_TRUE(input_->events.try_push_back(seen));
  step(1005.1);
  EXPECT_FALSE(news_.claim().has_value());
}

TEST_F(OverlayNewsTest, AConfirmationGoesWithTheToolAndWithTheTrack) {
  for (const bool lost : {false, true}) {
    output_->sighting.tool_known = true;
    output_->sighting.tool = {40, 61};
    claim_with(core::ClaimVerdict::kConfirmed);
    step(10.0);
    EXPECT_TRUE(news_.claim().has_value());

    output_->sighting.tool = {40, 62};
    output_->sighting.tool_known = !lost;
    step(10.1);
    EXPECT_FALSE(news_.claim().has_value());
  }
}

TEST_F(OverlayNewsTest, TakesAnyClickFromOutside) {
  core::Start start = three_clicks();
  start.tubes[0].at_px = {std::numeric_limits<double>::quiet_NaN(), 1e300};
  start.tubes[1].at_px = {-1e300, std::numeric_limits<double>::infinity()};
  start_with({core::StartRefusal::kNoTubeThere, 0}, start);
  step(10.0, core::TrackState::kWaiting);

  EXPECT_EQ(news_.clicks()[0].at_px.u_q16, 0);
  EXPECT_EQ(news_.clicks()[0].at_px.v_q16, 32'000 * 65'536);
  EXPECT_EQ(news_.clicks()[1].at_px.u_q16, -32'000 * 65'536);
}

}  // namespace
}  // namespace tubesight::board
