// A start must fit what the box has just seen: nobody comes from there faster than the tool goes.

#include <vector>

#include <gtest/gtest.h>

#include "tests/core/session/sheet_run.h"

namespace tubesight::core::session {
namespace {

using tests::content_of;

class StartPlace : public ::testing::Test {
 protected:
  void SetUp() override { run_.configure(); }

  /// A start at `place` whose addresses are so far off; what the box says to it in the next field.
  StartRefusal start(const ToolPlace& place, TubeAddress off, bool confirmed = false) {
    std::vector<TubeAddress> tubes = run_.middle_tubes(place);
    tests::set_clicks(*run_.sheet, place, tubes, {3.0, -2.0}, *run_.settings);
    Start clicks{run_.settings->start.tubes, {}, confirmed};
    for (StartPoint& click : clicks.tubes) {
      click.address.row += off.row;
      click.address.column += off.column;
    }
    run_.add(tests::event_of(clicks));
    run_.step(place);
    EXPECT_FALSE(run_.output().replies.empty());
    for (const Reply& reply : run_.output().replies) {
      if (const auto* const answer = content_if<StartReply>(reply)) {
        return answer->refusal;
      }
    }
    ADD_FAILURE() << "no answer";
    return StartRefusal::kNone;
  }

  /// Dark fields until the track is lost.
  void lose(const ToolPlace& place) {
    run_.sheet->look.gain = 0.0;
    for (int i = 0; i < 60 && run_.sighting().state != TrackState::kLost; ++i) {
      run_.step(place);
    }
    ASSERT_EQ(run_.sighting().state, TrackState::kLost);
    run_.sheet->look.gain = 1.0;
  }

  SheetRun<FixedPoint> run_;
};

TEST_F(StartPlace, ATrackThatIsWellIsBelievedAgainstAStart) {
  run_.begin();
  for (const TubeAddress off : {TubeAddress{1, 0}, {0, -1}, {3, 2}, {15, 0}}) {
    run_.add_claim(kTube);
    EXPECT_EQ(start(kOverTube, off), StartRefusal::kElsewhere) << off.row << "," << off.column;
    EXPECT_EQ(run_.sighting().state, TrackState::kTracking);
    EXPECT_EQ(run_.sighting().tool, kTube);
    EXPECT_TRUE(run_.sighting().aligned);
  }
}

TEST_F(StartPlace, ClaimsOfTheTimeBeforeAreStillAnswered) {
  run_.begin();
  Event claim = tests::event_of(Claim{kTube});
  claim.at = run_.now - 2 * kFieldSpan;
  run_.add(claim);
  EXPECT_EQ(start(kOverTube, {1, 0}), StartRefusal::kElsewhere);
  EXPECT_EQ(content_of<ClaimReply>(run_.output().replies[0]).verdict, ClaimVerdict::kConfirmed);
}

TEST_F(StartPlace, AStartThatAgreesReplacesTheTrack) {
  run_.begin();
  EXPECT_EQ(start(kOverTube, {0, 0}), StartRefusal::kNone);
  EXPECT_EQ(run_.sighting().tool, kTube);
  const ToolPlace place = moved(kOverTube, 3.0);
  EXPECT_EQ(start(place, {0, 0}), StartRefusal::kNone) << "and so does one a little farther";
}

TEST_F(StartPlace, WhoeverInsistsIsBelieved) {
  run_.begin();
  // A whole step that no picture showed: the person is right, and the track is not.
  EXPECT_EQ(start(moved(kOverTube, 0.0, kPitch_mm), {0, 0}, true), StartRefusal::kNone);
  EXPECT_EQ(run_.sighting().state, TrackState::kTracking);
  EXPECT_EQ(run_.sighting().tool, (TubeAddress{21, 10}));
  EXPECT_TRUE(run_.sighting().aligned);
}

TEST_F(StartPlace, AfterALossNobodyComesFromFartherThanTheToolGoes) {
  run_.begin();
  lose(kOverTube);
  const Reason why = run_.sighting().reason;
  EXPECT_EQ(start(kOverTube, {20, 0}), StartRefusal::kElsewhere);
  EXPECT_EQ(run_.sighting().state, TrackState::kLost) << "nothing changes by it";
  EXPECT_EQ(run_.sighting().reason, why);
  // 20 rows are 508 mm: 1.65 s at 300 mm/s, less half a step.
  run_.drop(static_cast<int>(1.7 / kFieldSpan_s));
  EXPECT_EQ(start(moved(kOverTube, 0.0, 20 * kPitch_mm), {0, 0}), StartRefusal::kNone);
  EXPECT_EQ(run_.sighting().tool, (TubeAddress{40, 10}));
}

TEST_F(StartPlace, AfterALossAStartWhereTheToolWasIsTakenAtOnce) {
  run_.begin();
  lose(kOverTube);
  EXPECT_EQ(start(kOverTube, {0, 0}), StartRefusal::kNone);
  EXPECT_EQ(run_.sighting().tool, kTube);
}

TEST_F(StartPlace, ARefusedStartOnAPictureWithoutTubesForgetsNothing) {
  run_.begin();
  run_.add(tests::event_of(Start{}));
  run_.step(kOverTube);
  ASSERT_EQ(run_.sighting().state, TrackState::kWaiting);
  EXPECT_EQ(start(kOverTube, {1, 0}), StartRefusal::kElsewhere);
  EXPECT_EQ(start(kOverTube, {0, 0}), StartRefusal::kNone);
}

TEST_F(StartPlace, WhereTimeGoesBackNoneHasPassed) {
  run_.begin();
  run_.now -= std::chrono::seconds(100);
  EXPECT_EQ(start(kOverTube, {1, 0}), StartRefusal::kElsewhere);
  EXPECT_EQ(start(kOverTube, {0, 0}), StartRefusal::kNone);
}

TEST_F(StartPlace, TheFirstStartIsTakenAtItsWord) {
  EXPECT_EQ(start(moved(kOverTube, 0.0, 5 * kPitch_mm), {0, 0}), StartRefusal::kNone);
}

}  // namespace
}  // namespace tubesight::core::session
