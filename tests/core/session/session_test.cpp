#include "core/session/session.h"

#include <gtest/gtest.h>

#include "tests/core/session/sheet_run.h"

namespace tubesight::core::session {
namespace {

using tests::content_of;
using tracking::StartRefusal;

Event pose_request() { return tests::event_of(PoseRequest{}); }

Event pose_result(TubeAddress nearest) {
  PoseResult pose;
  pose.reason = PoseReason::kNone;
  pose.position_nm = {254'000'000, 508'000'000, -60'000'000};
  pose.nearest = nearest;
  return tests::event_of(pose);
}

class SessionOf : public ::testing::Test {
 protected:
  void SetUp() override { run_.configure(); }

  template <typename Content>
  [[nodiscard]] Content only_reply() const {
    EXPECT_EQ(run_.output().replies.size(), 1);
    return content_of<Content>(run_.output().replies.empty() ? Reply{} : run_.output().replies[0]);
  }

  SheetRun<FixedPoint> run_;
};

TEST_F(SessionOf, WaitsUntilSomebodyNamesTubes) {
  for (int i = 0; i < 3; ++i) {
    run_.step(kOverTube);
    EXPECT_EQ(run_.sighting().state, TrackState::kWaiting);
    EXPECT_EQ(run_.sighting().reason, Reason::kNoStart);
    EXPECT_TRUE(run_.output().replies.empty());
  }
}

TEST_F(SessionOf, TakesAStartInTheFieldThatItCameWith) {
  run_.add_start(kOverTube, {{20, 10}, {21, 10}, {20, 11}});
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kTracking);
  EXPECT_EQ(run_.sighting().tool, kTube);
  EXPECT_TRUE(run_.sighting().aligned);
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kNone);
}

TEST(SessionEdges, TakeAStartWhereZeroAsksForTheProgramsOwnThresholds) {
  SheetRun<FixedPoint> run;
  run.settings->edges = {0, 0};
  run.configure();
  run.begin();
  EXPECT_TRUE(run.sighting().aligned);
}

TEST_F(SessionOf, RefusesAStartAndSaysWhy) {
  run_.add_start(kOverTube, {{20, 10}, {21, 10}});
  run_.step(kOverTube);
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kTooFew);
  EXPECT_EQ(run_.sighting().state, TrackState::kWaiting);
  EXPECT_EQ(run_.sighting().reason, Reason::kStartRefused);
}

TEST_F(SessionOf, RefusesAStartOnAPictureThatShowsOtherTubeEndsElsewhere) {
  // The three clicked tube-ends stand; all others are blank though the settings have them.
  for (std::int32_t row = 0; row < 40; ++row) {
    for (std::int32_t column = -10; column < 30; ++column) {
      const TubeAddress tube{row, column};
      if (tube != TubeAddress{20, 10} && tube != TubeAddress{21, 10} &&
          tube != TubeAddress{20, 11}) {
        run_.sheet->look.flush_plugs.push_back(tube);
      }
    }
  }
  run_.add_start(kOverTube, {{20, 10}, {21, 10}, {20, 11}});
  run_.step(kOverTube);
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kPicture);
}

TEST_F(SessionOf, RefusesAStartThatOneClickContradictsHoweverFarApart) {
  // A step wrong on one of three far clicks changes the similarity by little.
  for (const int wrong : {0, 1, 2}) {
    for (const TubeAddress error : {TubeAddress{1, 0}, {0, -1}}) {
      tests::set_clicks(*run_.sheet, kOverTube, {{21, 10}, {19, 8}, {23, 12}}, {3.0, -2.0},
                        *run_.settings);
      Start start{run_.settings->start.tubes, {}, false};
      start.tubes[wrong].address.row += error.row;
      start.tubes[wrong].address.column += error.column;
      run_.add(tests::event_of(start));
      run_.step(kOverTube);
      EXPECT_NE(only_reply<StartReply>().refusal, StartRefusal::kNone) << wrong;
      EXPECT_EQ(run_.sighting().state, TrackState::kWaiting) << wrong;
    }
  }
}

TEST_F(SessionOf, RefusesAStartInADamagedOrBlackField) {
  run_.add_start(kOverTube, {{20, 10}, {21, 10}, {20, 11}});
  run_.status = FieldStatus::kDamaged;
  run_.step(kOverTube);
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kPicture);
  run_.sheet->look.gain = 0.0;
  run_.add_start(kOverTube, {{20, 10}, {21, 10}, {20, 11}});
  run_.step(kOverTube);
  EXPECT_NE(only_reply<StartReply>().refusal, StartRefusal::kNone);
  EXPECT_EQ(run_.sighting().state, TrackState::kWaiting);
}

TEST_F(SessionOf, GivesARunningTrackUpForANewStartEvenARefusedOne) {
  run_.begin();
  run_.add_start(kOverTube, {{20, 10}});
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kWaiting);
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kWaiting);
}

TEST_F(SessionOf, ConfirmsARightClaimAndContradictsAWrongOne) {
  run_.begin();
  run_.add_claim(kTube);
  run_.add_claim({20, 11});
  run_.step(kOverTube);
  const auto& replies = run_.output().replies;
  ASSERT_EQ(replies.size(), 2);
  const auto right = content_of<ClaimReply>(replies[0]);
  const auto wrong = content_of<ClaimReply>(replies[1]);
  EXPECT_EQ(right.verdict, ClaimVerdict::kConfirmed);
  EXPECT_EQ(right.claimed, kTube);
  EXPECT_EQ(right.tube, kTube);
  EXPECT_EQ(wrong.verdict, ClaimVerdict::kContradicted);
  EXPECT_EQ(wrong.claimed, (TubeAddress{20, 11}));
  EXPECT_EQ(wrong.tube, kTube) << "the tube that the box vouches for";
}

TEST_F(SessionOf, CannotTellWhatToSayToAClaimWithoutAnAlignedTube) {
  run_.add_claim(kTube);
  run_.step(kOverTube);
  EXPECT_EQ(only_reply<ClaimReply>().verdict, ClaimVerdict::kUnknown) << "waiting";

  run_.begin();
  for (int i = 0; i < 20; ++i) {
    run_.step(moved(kOverTube, way_after(i * kFieldSpan_s, 8.0, 100.0, 2000.0)));
  }
  run_.add_claim(kTube);
  run_.step(moved(kOverTube, 8.0));
  ASSERT_EQ(run_.sighting().state, TrackState::kTracking);
  EXPECT_EQ(only_reply<ClaimReply>().verdict, ClaimVerdict::kUnknown)
      << "8 mm off, beyond aligned_within_mm";

  run_.sheet->look.gain = 0.0;
  run_.add_claim(kTube);
  run_.step(moved(kOverTube, 8.0));
  EXPECT_EQ(only_reply<ClaimReply>().verdict, ClaimVerdict::kUnknown) << "coasting";
}

TEST_F(SessionOf, NamesTheTubeThatTheOperatorPicks) {
  run_.add_pick(run_.sheet->image_of(kOverTube, kTube));
  run_.step(kOverTube);
  EXPECT_EQ(only_reply<PickReply>().doubt, PickDoubt::kNotTracking) << "waiting";

  run_.begin();
  for (const TubeAddress tube : {TubeAddress{20, 10}, TubeAddress{22, 9}, TubeAddress{21, 12}}) {
    const auto center = run_.sheet->center_of(tube);
    // Anywhere in the tube's cell, 9 mm off here.
    run_.add_pick(run_.sheet->image_of(kOverTube, {center[0] + 7.0, center[1] - 6.0, 0.0}));
    run_.step(kOverTube);
    EXPECT_EQ(only_reply<PickReply>().doubt, PickDoubt::kNone);
    EXPECT_EQ(only_reply<PickReply>().tube, tube);
  }
}

TEST(SessionPick, FindsNoTubeInAVoid) {
  SheetRun<FixedPoint> run;
  ASSERT_TRUE(run.settings->tubesheet.missing.try_push_back({22, 10}));
  run.configure();
  run.begin();
  run.add_pick(run.sheet->image_of(kOverTube, TubeAddress{22, 10}));
  run.step(kOverTube);
  ASSERT_EQ(run.output().replies.size(), 1);
  EXPECT_NE(content_of<PickReply>(run.output().replies[0]).doubt, PickDoubt::kNone);
}

TEST_F(SessionOf, AnswersEveryEventInOrder) {
  run_.add_start(kOverTube, {{20, 10}, {21, 10}, {20, 11}});
  run_.add_claim(kTube);
  run_.add(tests::event_of(LampCommand{500}));
  run_.add(pose_request());
  run_.add(tests::event_of(Acknowledge{}, EventOrigin::kOperator));
  run_.step(kOverTube);
  const auto& replies = run_.output().replies;
  ASSERT_EQ(replies.size(), 5);
  EXPECT_EQ(content_of<StartReply>(replies[0]).refusal, StartRefusal::kNone);
  EXPECT_EQ(content_of<ClaimReply>(replies[1]).verdict, ClaimVerdict::kConfirmed);
  EXPECT_TRUE(tests::is<NotServedReply>(replies[2]));
  EXPECT_EQ(content_of<PoseRequestReply>(replies[3]).refusal, PoseReason::kNone);
  EXPECT_TRUE(tests::is<NotServedReply>(replies[4]));
  EXPECT_EQ(replies[3].origin, EventOrigin::kRobot);
  EXPECT_EQ(replies[4].origin, EventOrigin::kOperator);
  EXPECT_EQ(run_.output().lamp_permille, 700);
}

TEST_F(SessionOf, OrdersAPoseWithTheTubesThatItSees) {
  run_.begin();
  run_.add(pose_request());
  const Output& output = run_.step(kOverTube);

  ASSERT_EQ(output.replies.size(), 1);
  EXPECT_EQ(content_of<PoseRequestReply>(output.replies[0]).refusal, PoseReason::kNone);
  ASSERT_TRUE(output.order.wanted);
  ASSERT_GE(output.order.tubes.size(), 3);
  for (const PoseOrderTube& tube : output.order.tubes) {
    const auto at = run_.sheet->image_of(kOverTube, tube.address);
    EXPECT_NEAR(tube.center_px.u_q16 / 65536.0, at[0], 1.0);
    EXPECT_NEAR(tube.center_px.v_q16 / 65536.0, at[1], 1.0);
  }
  run_.step(kOverTube);
  EXPECT_FALSE(output.order.wanted);
}

TEST_F(SessionOf, TakesOnePoseRequestAtATimeUntilItsResultCame) {
  run_.begin();
  run_.add(pose_request());
  run_.step(kOverTube);
  run_.add(pose_request());
  const Output& output = run_.step(kOverTube);
  ASSERT_EQ(output.replies.size(), 1);
  EXPECT_EQ(content_of<PoseRequestReply>(output.replies[0]).refusal, PoseReason::kBusy);

  run_.add(pose_result(kTube));
  run_.add(pose_request());
  run_.step(kOverTube);
  ASSERT_EQ(output.replies.size(), 2);
  EXPECT_EQ(content_of<PoseRequestReply>(output.replies[1]).refusal, PoseReason::kNone);
}

TEST_F(SessionOf, ComparesAPoseResultWithTheTubeThatItSees) {
  run_.begin();
  run_.add(pose_result(kTube));
  run_.add(pose_result({21, 10}));
  PoseResult refused;
  refused.reason = PoseReason::kMoving;
  run_.add(tests::event_of(refused));
  const Output& output = run_.step(kOverTube);

  ASSERT_EQ(output.replies.size(), 3);
  const auto right = content_of<PoseReply>(output.replies[0]);
  const auto wrong = content_of<PoseReply>(output.replies[1]);
  const auto none = content_of<PoseReply>(output.replies[2]);
  EXPECT_EQ(right.verdict, PoseVerdict::kConfirmed);
  EXPECT_EQ(right.pose.position_nm[0], 254'000'000);
  EXPECT_EQ(wrong.verdict, PoseVerdict::kContradicted);
  EXPECT_EQ(wrong.tube, kTube);
  EXPECT_EQ(none.verdict, PoseVerdict::kRefused);
  EXPECT_EQ(none.pose.reason, PoseReason::kMoving);
}

TEST_F(SessionOf, RefusesAPoseRequestBeforeItKnowsTheTubes) {
  run_.add(pose_request());
  const Output& output = run_.step(kOverTube);

  ASSERT_EQ(output.replies.size(), 1);
  EXPECT_EQ(content_of<PoseRequestReply>(output.replies[0]).refusal, PoseReason::kNotTracking);
  EXPECT_FALSE(output.order.wanted);
}

TEST_F(SessionOf, RefusesAPoseRequestWhileTheToolMoves) {
  run_.begin();
  ToolPlace place = kOverTube;
  for (int i = 0; i < 12; ++i) {
    place = moved(place, 0.05 * i);
    run_.step(place);
  }
  run_.add(pose_request());
  const Output& output = run_.step(moved(place, 0.6));

  ASSERT_EQ(output.replies.size(), 1);
  EXPECT_EQ(content_of<PoseRequestReply>(output.replies[0]).refusal, PoseReason::kMoving);
}

TEST_F(SessionOf, KeepsItsTrackingStateSmall) {
  EXPECT_LE(Session<FixedPoint>::tracking_state_bytes(), 64 * 1024);
}

TEST(SessionConfigure, RefusesSettingsOutOfRange) {
  const auto settings = std::make_unique<SessionSettings>();
  const auto session = std::make_unique<Session<FixedPoint>>();
  tests::make_synthetic_settings(*settings);
  EXPECT_TRUE(session->configure(*settings).has_value());
  settings->tubesheet.rows = {5, 4};
  EXPECT_EQ(session->configure(*settings).error(), Error::kInvalidArgument);
  settings->tubesheet.rows = {4, 5};
  settings->camera.focal_length_mm = -1.0;
  EXPECT_EQ(session->configure(*settings).error(), Error::kOutOfRange);
}

}  // namespace
}  // namespace tubesight::core::session
