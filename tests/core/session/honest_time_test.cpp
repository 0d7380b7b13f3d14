// Time that is told as it is: fields that do not come, and clicks into pictures gone by.

#include <gtest/gtest.h>

#include "tests/core/session/sheet_run.h"

namespace tubesight::core::session {
namespace {

using tests::content_of;

constexpr std::array<TubeAddress, 3> kClicked = {TubeAddress{20, 10}, {21, 10}, {20, 11}};

class HonestTime : public ::testing::Test {
 protected:
  void SetUp() override { run_.configure(); }

  template <typename Content>
  [[nodiscard]] Content only_reply() const {
    EXPECT_EQ(run_.output().replies.size(), 1);
    return content_of<Content>(run_.output().replies.empty() ? Reply{} : run_.output().replies[0]);
  }

  /// Clicks on the tubes as they stood at `seen_place`, in the picture of field `seen`.
  void add_start(const ToolPlace& seen_place, std::optional<std::int64_t> seen) {
    tests::set_clicks(*run_.sheet, seen_place, {kClicked.begin(), kClicked.end()}, {3.0, -2.0},
                      *run_.settings);
    run_.add(
        tests::event_of(Start{run_.settings->start.tubes, seen, false}, EventOrigin::kOperator));
  }

  /// Moves at 100 mm/s by `way_mm` along a row and rests.
  void travel(double way_mm) {
    const double whole_s = way_mm / 100.0 + 0.1;
    for (double t = 0.0; t < whole_s; t += kFieldSpan_s) {
      run_.step(moved(kOverTube, way_after(t, way_mm, 100.0, 2000.0)));
    }
  }

  SheetRun<FixedPoint> run_;
};

TEST_F(HonestTime, AMissingFieldIsCoastedThroughAndSaidToBeMissing) {
  run_.begin();
  ASSERT_TRUE(run_.sighting().aligned);
  const std::int64_t judged = run_.sighting().judged_fields;

  run_.add_claim(kTube);
  run_.miss(kOverTube);

  EXPECT_EQ(run_.sighting().state, TrackState::kDegraded);
  EXPECT_EQ(run_.sighting().reason, Reason::kNoField);
  EXPECT_FALSE(run_.sighting().aligned);
  EXPECT_EQ(run_.sighting().status, FieldStatus::kMissing);
  EXPECT_EQ(run_.sighting().judged_fields, judged);
  EXPECT_GT(run_.sighting().age, FieldTime(0));
  EXPECT_EQ(only_reply<ClaimReply>().doubt, ClaimDoubt::kNoPicture);

  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kTracking);
  EXPECT_EQ(run_.sighting().judged_fields, judged + 1);
  EXPECT_EQ(run_.sighting().age, FieldTime(0));
}

TEST_F(HonestTime, AFieldThatComesAfterItWasGivenUpIsTaken) {
  run_.begin();
  run_.miss(kOverTube, true);
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kTracking);
  EXPECT_TRUE(run_.sighting().aligned);
}

TEST_F(HonestTime, WithoutFieldsTheTrackEndsAsWithDamagedOnes) {
  run_.begin();
  int coasted = 0;
  while (run_.sighting().state != TrackState::kLost) {
    run_.miss(kOverTube);
    EXPECT_FALSE(run_.sighting().aligned);
    ASSERT_LT(++coasted, 30);
  }
  EXPECT_EQ(run_.sighting().reason, Reason::kCoasted);
  for (int i = 0; i < 100; ++i) {
    run_.miss(kOverTube);
    EXPECT_EQ(run_.sighting().state, TrackState::kLost);
  }
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kLost) << "a camera that is back resumes nothing";
}

TEST_F(HonestTime, AStartInAMissingFieldIsRefused) {
  run_.add_start(kOverTube, {kClicked.begin(), kClicked.end()});
  run_.miss(kOverTube);
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kPicture);
  EXPECT_EQ(run_.sighting().state, TrackState::kWaiting);
}

TEST_F(HonestTime, OnlyJudgedFieldsCount) {
  for (int i = 0; i < 3; ++i) {
    run_.step(kOverTube);
    EXPECT_EQ(run_.sighting().judged_fields, 0) << "waiting: nothing is judged";
  }
  run_.begin();
  const std::int64_t judged = run_.sighting().judged_fields;
  EXPECT_EQ(judged, 4);
  run_.status = FieldStatus::kDamaged;
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().judged_fields, judged);
  EXPECT_EQ(run_.sighting().age, kFieldSpan);
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().judged_fields, judged + 1);
}

// Rests first, so that the box learns that its camera has noise.
TEST_F(HonestTime, AFrozenCameraShowsInTheCountWithinTwoFields) {
  run_.sheet->look.noise = 3.0;
  run_.begin();
  for (int i = 0; i < 10; ++i) {
    run_.step(kOverTube);
  }
  const std::int64_t judged = run_.sighting().judged_fields;
  run_.step_on_last_picture(kOverTube);  // of the other parity: not yet the old picture
  run_.step_on_last_picture(kOverTube);
  run_.step_on_last_picture(kOverTube);
  EXPECT_LE(run_.sighting().judged_fields, judged + 1);
  EXPECT_FALSE(run_.sighting().aligned);
}

TEST_F(HonestTime, OfTwoStartsBeforeOneFieldTheLastCountsAndEachHasItsAnswer) {
  add_start(kOverTube, std::nullopt);
  run_.add(tests::event_of(Start{}));  // no clicks at all
  run_.step(kOverTube);
  ASSERT_EQ(run_.output().replies.size(), 2);
  EXPECT_EQ(content_of<StartReply>(run_.output().replies[0]).refusal, StartRefusal::kSuperseded);
  EXPECT_EQ(content_of<StartReply>(run_.output().replies[1]).refusal, StartRefusal::kTooFew);
  EXPECT_EQ(run_.sighting().state, TrackState::kWaiting);

  run_.add(tests::event_of(Start{}));
  add_start(kOverTube, std::nullopt);
  run_.step(kOverTube);
  ASSERT_EQ(run_.output().replies.size(), 2);
  EXPECT_EQ(content_of<StartReply>(run_.output().replies[0]).refusal, StartRefusal::kSuperseded);
  EXPECT_EQ(content_of<StartReply>(run_.output().replies[1]).refusal, StartRefusal::kNone);
  EXPECT_EQ(run_.sighting().state, TrackState::kTracking);
}

TEST_F(HonestTime, AStartOnAnOlderPictureIsTakenWhereTheToolRested) {
  run_.sheet->look.noise = 3.0;
  for (int i = 0; i < 60; ++i) {
    run_.step(kOverTube);
  }
  add_start(kOverTube, run_.number - 50);
  run_.step(kOverTube);
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kNone);
  EXPECT_EQ(run_.sighting().tool, kTube);
}

// The picture is the same again after a whole step: only what was seen in between tells.
TEST_F(HonestTime, AStartOnAPictureBeforeAMoveByAWholeStepIsRefused) {
  for (int i = 0; i < 10; ++i) {
    run_.step(kOverTube);
  }
  const std::int64_t seen = run_.number;
  travel(kPitch_mm);
  add_start(kOverTube, seen);
  run_.step(moved(kOverTube, kPitch_mm));
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kMoved);
  EXPECT_EQ(run_.sighting().state, TrackState::kWaiting);

  add_start(moved(kOverTube, kPitch_mm), run_.number);
  run_.step(moved(kOverTube, kPitch_mm));
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kNone) << "into the picture after it";
  EXPECT_EQ(run_.sighting().tool, (TubeAddress{20, 11}));
}

TEST_F(HonestTime, AStartOnAPictureBeforeAGapOrADamagedFieldIsRefused) {
  for (const bool gap : {true, false}) {
    for (int i = 0; i < 5; ++i) {
      run_.step(kOverTube);
    }
    const std::int64_t seen = run_.number;
    if (gap) {
      run_.drop(10);
    } else {
      run_.status = FieldStatus::kDamaged;
    }
    run_.step(kOverTube);
    run_.step(kOverTube);
    add_start(kOverTube, seen);
    run_.step(kOverTube);
    EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kMoved) << gap;
  }
}

TEST_F(HonestTime, AStartOnAFieldStillToComeIsRefused) {
  for (const std::int64_t field : {run_.number + 2, std::int64_t{-1}}) {
    add_start(kOverTube, field);
    run_.step(kOverTube);
    EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kUnknownField) << field;
  }
}

TEST_F(HonestTime, WhileTrackingTheTrackTellsWhetherTheToolRested) {
  run_.begin();
  for (int i = 0; i < 10; ++i) {
    run_.step(kOverTube);
  }
  const std::int64_t seen = run_.number - 5;
  add_start(kOverTube, seen);
  run_.step(kOverTube);
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kNone);

  for (int i = 0; i < 5; ++i) {
    run_.step(kOverTube);
  }
  const std::int64_t before = run_.number;
  travel(kPitch_mm);
  ASSERT_EQ(run_.sighting().state, TrackState::kTracking);
  add_start(kOverTube, before);
  run_.step(moved(kOverTube, kPitch_mm));
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kMoved);
  EXPECT_EQ(run_.sighting().state, TrackState::kTracking) << "the track goes on";
  EXPECT_EQ(run_.sighting().tool, (TubeAddress{20, 11}));
}

// While nobody looked the tool can have gone to the next tube, where the picture is the same.
TEST_F(HonestTime, AStartOnAPictureBeforeAGapIsRefusedThoughTheTrackRested) {
  run_.begin();
  for (int i = 0; i < 10; ++i) {
    run_.step(kOverTube);
  }
  const std::int64_t seen = run_.number;
  run_.drop(8);
  tests::set_clicks(*run_.sheet, kOverTube, {kClicked.begin(), kClicked.end()}, {3.0, -2.0},
                    *run_.settings);
  run_.add(tests::event_of(Start{run_.settings->start.tubes, seen, false}));
  run_.step(moved(kOverTube, kPitch_mm));
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kMoved);
  EXPECT_FALSE(run_.sighting().aligned);
}

TEST_F(HonestTime, AStartOnAPictureBeforeAStoppedFrameStoreIsRefused) {
  run_.sheet->look.noise = 3.0;
  for (int i = 0; i < 12; ++i) {
    run_.step(kOverTube);
  }
  const std::int64_t seen = run_.number;
  for (int i = 0; i < 10; ++i) {
    run_.step_on_last_picture(kOverTube);  // meanwhile the tool goes on by a step
  }
  for (int i = 0; i < 4; ++i) {
    run_.step(moved(kOverTube, kPitch_mm));
  }
  add_start(kOverTube, seen);
  run_.step(moved(kOverTube, kPitch_mm));
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kMoved);
}

TEST_F(HonestTime, AStartWithoutAPictureLeavesAGoodTrackAlone) {
  run_.begin();
  add_start(kOverTube, std::nullopt);
  run_.status = FieldStatus::kDamaged;
  run_.step(kOverTube);
  EXPECT_EQ(only_reply<StartReply>().refusal, StartRefusal::kPicture);
  EXPECT_EQ(run_.sighting().state, TrackState::kDegraded);
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kTracking);
}

// The track before a new start was wrong, or there would be none.
TEST_F(HonestTime, ANewStartEndsWhatTheTrackBeforeItVouchesFor) {
  run_.begin();
  run_.step(kOverTube);
  add_start(kOverTube, std::nullopt);
  Event claim = tests::event_of(Claim{kTube});
  claim.at = run_.now - kFieldSpan;
  run_.add(claim);
  run_.step(kOverTube);
  ASSERT_EQ(run_.output().replies.size(), 2);
  EXPECT_EQ(content_of<StartReply>(run_.output().replies[0]).refusal, StartRefusal::kNone);
  EXPECT_EQ(content_of<ClaimReply>(run_.output().replies[1]).field, run_.number)
      << "not by the field before the start";
}

TEST_F(HonestTime, APickBesideThePictureNamesNoTube) {
  run_.begin();
  for (const std::array<double, 2>& at :
       {std::array{-1.0, 100.0}, std::array{100.0, 1e4}, std::array{65000.0, 65000.0}}) {
    run_.add_pick(at);
    run_.step(kOverTube);
    EXPECT_EQ(only_reply<PickReply>().doubt, PickDoubt::kNoTube);
  }
}

TEST_F(HonestTime, APickIsJudgedInTheFieldThatWasSeen) {
  run_.begin();
  const std::int64_t seen = run_.number;
  const auto at = run_.sheet->image_of(kOverTube, TubeAddress{21, 11});
  travel(kPitch_mm);

  run_.add(tests::event_of(Pick{at, seen}, EventOrigin::kOperator));
  run_.step(moved(kOverTube, kPitch_mm));
  EXPECT_EQ(only_reply<PickReply>().doubt, PickDoubt::kNone);
  EXPECT_EQ(only_reply<PickReply>().tube, (TubeAddress{21, 11}));

  run_.add_pick(at);
  run_.step(moved(kOverTube, kPitch_mm));
  EXPECT_EQ(only_reply<PickReply>().tube, (TubeAddress{21, 12})) << "in the present field";
}

TEST_F(HonestTime, APickInAFieldForgottenOrToComeIsRefused) {
  run_.begin();
  const std::int64_t seen = run_.number;
  const auto at = run_.sheet->image_of(kOverTube, kTube);
  for (int i = 0; i < 260; ++i) {
    run_.step_on_last_picture(kOverTube);
  }
  for (const std::int64_t field : {seen, run_.number + 9}) {
    run_.add(tests::event_of(Pick{at, field}, EventOrigin::kOperator));
    run_.step(kOverTube);
    EXPECT_EQ(only_reply<PickReply>().doubt, PickDoubt::kUnknownField);
  }
}

TEST_F(HonestTime, ALampCommandIsServedWhereSomebodyDims) {
  run_.lamp_dimmed(true);
  run_.add(tests::event_of(LampCommand{430}));
  run_.step(kOverTube);
  EXPECT_EQ(only_reply<LampReply>().permille, 430);
  EXPECT_EQ(run_.output().lamp_permille, 430);
  run_.step(kOverTube);
  EXPECT_EQ(run_.output().lamp_permille, 430) << "until another level is commanded";
}

TEST_F(HonestTime, ABoxWithALevelOfItsOwnTakesItAgain) {
  run_.take_lamp({true, false, 1, kFullLamp_permille});
  run_.lamp_dimmed(true);
  run_.step(kOverTube);
  EXPECT_TRUE(run_.output().lamp_automatic);
  const std::int32_t own = run_.output().lamp_permille;

  run_.add(tests::event_of(LampCommand{430}));
  run_.step(kOverTube);
  EXPECT_FALSE(only_reply<LampReply>().automatic);
  EXPECT_FALSE(run_.output().lamp_automatic) << "commanded";
  EXPECT_EQ(run_.output().lamp_permille, 430);

  run_.add(tests::event_of(LampCommand{0, true}));
  run_.step(kOverTube);
  EXPECT_TRUE(only_reply<LampReply>().automatic);
  EXPECT_EQ(only_reply<LampReply>().permille, own);
  EXPECT_TRUE(run_.output().lamp_automatic);
  EXPECT_EQ(run_.output().lamp_permille, own);
}

TEST_F(HonestTime, ABoxWithoutALevelOfItsOwnKeepsWhatWasCommanded) {
  run_.lamp_dimmed(true);
  run_.add(tests::event_of(LampCommand{430}));
  run_.step(kOverTube);
  run_.add(tests::event_of(LampCommand{0, true}));
  run_.step(kOverTube);
  EXPECT_EQ(run_.output().replies.size(), 1);
  EXPECT_NE(content_if<NotServedReply>(run_.output().replies[0]), nullptr);
  EXPECT_EQ(run_.output().lamp_permille, 430);
  EXPECT_FALSE(run_.output().lamp_automatic);
}

}  // namespace
}  // namespace tubesight::core::session
