#include "board/bench/replay/replay_statistics.h"

#include <memory>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using core::ClaimVerdict;
using core::FieldTime;
using core::Reason;
using core::TrackState;
using core::session::Output;
using std::chrono::milliseconds;

/// Feeds a statistics object field by field.
class ReplayStatisticsTest : public ::testing::Test {
 protected:
  /// One field without events.
  void field(int time_ms, TrackState state, Reason reason = Reason::kNone, int tracked = 0) {
    output_->sighting = {};
    output_->sighting.time = milliseconds(time_ms);
    output_->sighting.state = state;
    output_->sighting.reason = reason;
    output_->sighting.tracked = tracked;
    statistics_.add(*output_);
    output_->replies.clear();
    output_->tubes.clear();
  }

  /// An answer that is given with the next field, at 20 ms.
  template <typename Content>
  void answer(const Content& content) {
    core::Reply reply;
    reply.at = milliseconds(20);
    reply.content = content;
    ASSERT_TRUE(output_->replies.try_push_back(reply));
  }
  void answer_claim(ClaimVerdict verdict, core::TubeAddress claimed, core::TubeAddress seen = {}) {
    core::ClaimReply reply;
    reply.claimed = claimed;
    reply.verdict = verdict;
    reply.tube = seen;
    answer(reply);
  }

  ReplayStatistics statistics_;
  std::unique_ptr<Output> output_ = std::make_unique<Output>();
};

TEST_F(ReplayStatisticsTest, ShareTheTimeUntilTheNextFieldOut) {
  field(0, TrackState::kWaiting, Reason::kNoStart);
  field(20, TrackState::kTracking);
  field(50, TrackState::kDegraded, Reason::kDark);
  field(60, TrackState::kDegraded, Reason::kFewTubes);
  field(80, TrackState::kLost, Reason::kCoasted);
  field(110, TrackState::kLost, Reason::kCoasted);
  statistics_.finish();

  EXPECT_EQ(statistics_.fields(), 6);
  EXPECT_EQ(statistics_.state(TrackState::kWaiting).time, milliseconds(20));
  EXPECT_EQ(statistics_.state(TrackState::kTracking).time, milliseconds(30));
  EXPECT_EQ(statistics_.state(TrackState::kDegraded).time, milliseconds(30));
  EXPECT_EQ(statistics_.degraded(Reason::kDark).time, milliseconds(10));
  EXPECT_EQ(statistics_.degraded(Reason::kFewTubes).time, milliseconds(20));
  EXPECT_EQ(statistics_.state(TrackState::kLost).fields, 2);
  // The last field stands for as long as the one before it.
  EXPECT_EQ(statistics_.state(TrackState::kLost).time, milliseconds(60));
  EXPECT_EQ(statistics_.end() - statistics_.begin(), milliseconds(140));
  ASSERT_EQ(statistics_.losses().size(), 1U);
  EXPECT_EQ(statistics_.losses()[0].at, milliseconds(80));
  EXPECT_EQ(statistics_.losses()[0].lasted, milliseconds(60));
  EXPECT_EQ(statistics_.losses()[0].reason, Reason::kCoasted);
}

TEST_F(ReplayStatisticsTest, CountEachLossOnce) {
  field(0, TrackState::kTracking);
  field(20, TrackState::kLost, Reason::kJump);
  field(40, TrackState::kTracking);
  field(60, TrackState::kLost, Reason::kGap);
  statistics_.finish();

  ASSERT_EQ(statistics_.losses().size(), 2U);
  EXPECT_EQ(statistics_.losses()[0].reason, Reason::kJump);
  EXPECT_EQ(statistics_.losses()[0].lasted, milliseconds(20));
  EXPECT_EQ(statistics_.losses()[1].reason, Reason::kGap);
}

TEST_F(ReplayStatisticsTest, TakeNoTimeAwayWhenTimeRunsBackwards) {
  field(100, TrackState::kTracking);
  field(40, TrackState::kLost, Reason::kTime);
  field(60, TrackState::kLost, Reason::kTime);
  statistics_.finish();

  EXPECT_EQ(statistics_.state(TrackState::kTracking).time, milliseconds(0));
  EXPECT_EQ(statistics_.state(TrackState::kLost).time, milliseconds(40));
}

TEST_F(ReplayStatisticsTest, StayAtZeroWithoutFields) {
  statistics_.finish();

  EXPECT_EQ(statistics_.fields(), 0);
  EXPECT_EQ(statistics_.state(TrackState::kWaiting).fields, 0);
  EXPECT_LT(statistics_.largest_speed_mm_s(), 0.0);
}

TEST_F(ReplayStatisticsTest, FindTheLargestSpeedWhileTracking) {
  const auto moving = [&](int time_ms, TrackState state, int x, int y) {
    output_->sighting = {};
    output_->sighting.time = milliseconds(time_ms);
    output_->sighting.state = state;
    output_->sighting.velocity_known = true;
    output_->sighting.velocity_um_s = {x, y};
    statistics_.add(*output_);
  };
  moving(0, TrackState::kTracking, 30000, -40000);
  moving(20, TrackState::kTracking, 1000, 0);
  moving(40, TrackState::kLost, 900000, 0);
  statistics_.finish();

  EXPECT_DOUBLE_EQ(statistics_.largest_speed_mm_s(), 50.0);
  EXPECT_EQ(statistics_.largest_speed_at(), FieldTime(0));
}

TEST_F(ReplayStatisticsTest, SumTubesAndNameEachPlugOnce) {
  core::TubeSighting plug;
  plug.address = {48, 60};
  plug.plug = true;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(output_->tubes.try_push_back(plug));
    field(20 * i, TrackState::kTracking, Reason::kNone, 10 + i);
  }
  field(60, TrackState::kLost, Reason::kJump);
  statistics_.finish();

  EXPECT_EQ(statistics_.tubes_used(), 21);
  ASSERT_EQ(statistics_.plugs().size(), 1U);
  EXPECT_EQ(*statistics_.plugs().begin(), (core::TubeAddress{48, 60}));
}

TEST_F(ReplayStatisticsTest, CountTheAnswersOfEachKind) {
  answer(core::StartReply{core::tracking::StartRefusal::kAddresses});
  answer(core::StartReply{});
  answer_claim(ClaimVerdict::kConfirmed, {1, 2}, {1, 2});
  answer_claim(ClaimVerdict::kContradicted, {1, 2}, {1, 3});
  answer_claim(ClaimVerdict::kUnknown, {1, 2});
  answer_claim(ClaimVerdict::kUnknown, {1, 2});
  answer(core::PickReply{core::PickDoubt::kNone, {1, 2}});
  answer(core::PickReply{core::PickDoubt::kNoTube, {}});
  answer(core::NotServedReply{});
  answer(core::PoseRequestReply{});
  answer(core::PoseRequestReply{core::PoseReason::kBusy});
  answer(core::PoseReply{core::PoseVerdict::kContradicted, {1, 2}, {}});
  field(20, TrackState::kTracking);
  statistics_.finish();

  ASSERT_EQ(statistics_.starts().size(), 2U);
  EXPECT_EQ(statistics_.starts()[0].reply.refusal, core::tracking::StartRefusal::kAddresses);
  EXPECT_EQ(statistics_.starts()[1].at, milliseconds(20));
  EXPECT_EQ(statistics_.claims_confirmed(), 1);
  ASSERT_EQ(statistics_.contradictions().size(), 1U);
  EXPECT_EQ(statistics_.contradictions()[0].seen, (core::TubeAddress{1, 3}));
  EXPECT_EQ(statistics_.claims_unknown(), 2);
  EXPECT_EQ(statistics_.picks_named(), 1);
  EXPECT_EQ(statistics_.picks_unknown(), 1);
  EXPECT_EQ(statistics_.not_served(), 1);
  // A request that is taken is told when its result comes.
  ASSERT_EQ(statistics_.poses().size(), 2U);
  EXPECT_FALSE(statistics_.poses()[0].contradicted);
  EXPECT_TRUE(statistics_.poses()[1].contradicted);
}

}  // namespace
}  // namespace tubesight::board
