#include "board/bench/campaign/move_judge.h"

#include <gtest/gtest.h>

namespace tubesight::board::campaign {
namespace {

using core::Reason;
using core::Sighting;
using core::TrackState;
using core::TubeAddress;

constexpr JudgeLimits kLimits{2.5, 25.4};
constexpr TubeAddress kTube{10, 20};
constexpr TubeAddress kNext{10, 21};

Sighting says(TubeAddress tube, bool aligned) {
  Sighting sighting;
  sighting.state = TrackState::kTracking;
  sighting.reason = Reason::kNone;
  sighting.tool_known = true;
  sighting.tool = tube;
  sighting.aligned = aligned;
  return sighting;
}

Sighting silent(TrackState state, Reason reason) {
  Sighting sighting;
  sighting.state = state;
  sighting.reason = reason;
  return sighting;
}

FieldTruth under(TubeAddress tube, double offset_mm) { return {tube, true, true, offset_mm, {}}; }

TEST(MoveJudge, FindsNothingWrongInTheTruth) {
  MoveJudge judge(kLimits);
  judge.take(under(kTube, 0.5), says(kTube, true));
  judge.take(under(kTube, 2.35), says(kTube, false));  // within 0.3 mm of the gate: either is right
  judge.take(under(kTube, 2.75), says(kTube, true));
  judge.take(under(kTube, 12.0), says(kNext, false));  // near half the pitch: either is right
  judge.take(under(kNext, 1.0), says(kNext, true));
  judge.take(under(kTube, 0.5), says(kTube, true));
  const Counts counts = judge.counts();
  Counts expected;
  expected[Count::kMoves] = 1;
  expected[Count::kFields] = 6;
  expected[Count::kTubes] = 3;
  expected[Count::kTrulyAligned] = 3;
  expected[Count::kVouched] = 4;
  expected[Count::kNamed] = 5;
  EXPECT_TRUE(counts == expected);
  EXPECT_EQ(judge.first_wrong_field(), -1);
}

TEST(MoveJudge, CountsAWrongTubeVouchedFor) {
  MoveJudge judge(kLimits);
  judge.take(under(kTube, 0.5), says(kTube, true));
  judge.take(under(kTube, 0.5), says(kNext, true));
  judge.take(under(kTube, 0.5), says(kNext, true));
  EXPECT_EQ(judge.counts()[Count::kWrongTube], 2);
  EXPECT_EQ(judge.counts()[Count::kMovesWrongTube], 1);
  EXPECT_EQ(judge.counts()[Count::kWrongNearest], 2);
  EXPECT_EQ(judge.counts()[Count::kMissed], 0);
  EXPECT_EQ(judge.first_wrong_field(), 1);
}

TEST(MoveJudge, CountsAVoidVouchedForAsWrong) {
  MoveJudge judge(kLimits);
  judge.take({kTube, false, true, 0.5, {}}, says(kTube, true));
  EXPECT_EQ(judge.counts()[Count::kWrongTube], 1);
  EXPECT_EQ(judge.counts()[Count::kTrulyAligned], 0);
}

TEST(MoveJudge, WantsNoTubeVouchedForThatIsClosedAndUntold) {
  MoveJudge judge(kLimits);
  const FieldTruth closed{kTube, true, false, 0.5, {}};
  judge.take(closed, says(kTube, false));
  EXPECT_EQ(judge.counts()[Count::kTrulyAligned], 0);
  EXPECT_EQ(judge.counts()[Count::kMissed], 0);
  judge.take(closed, says(kTube, true));  // a tube stands there all the same
  EXPECT_EQ(judge.counts()[Count::kWrongTube], 0);
  judge.take(closed, says(kNext, true));
  EXPECT_EQ(judge.counts()[Count::kWrongTube], 1);
}

TEST(MoveJudge, CountsTheGateWithItsSlack) {
  MoveJudge judge(kLimits);
  judge.take(under(kTube, 2.81), says(kTube, true));
  judge.take(under(kTube, 2.19), says(kTube, false));
  EXPECT_EQ(judge.counts()[Count::kFalseAligned], 1);
  EXPECT_EQ(judge.counts()[Count::kMissed], 1);
  EXPECT_EQ(judge.counts()[Count::kMissedLost], 0);
  EXPECT_EQ(judge.counts()[Count::kMovesMissed], 1);
}

TEST(MoveJudge, NamesWithoutVouchingAreWrongNearestOnly) {
  MoveJudge judge(kLimits);
  judge.take(under(kTube, 5.0), says(kNext, false));
  EXPECT_EQ(judge.counts()[Count::kWrongNearest], 1);
  EXPECT_EQ(judge.counts()[Count::kWrongTube], 0);
}

TEST(MoveJudge, CountsASilentJumpsOwnStepApart) {
  const FieldTruth jumped{kNext, true, true, 0.5, {0, 1}};
  MoveJudge judge(kLimits);
  judge.take(jumped, says(kTube, true));     // what a bare lattice leaves it to believe
  judge.take(jumped, says({11, 20}, true));  // wrong by another step
  judge.take(jumped, says(kNext, true));     // right
  const Counts counts = judge.counts();
  EXPECT_EQ(counts[Count::kUndetectable], 1);
  EXPECT_EQ(counts[Count::kMovesUndetectable], 1);
  EXPECT_EQ(counts[Count::kWrongTube], 1);
  EXPECT_EQ(counts[Count::kWrongNearest], 1);
}

TEST(MoveJudge, EndsWithTheTrackAndCountsTheRestAsMissed) {
  MoveJudge judge(kLimits);
  judge.take(under(kTube, 0.5), says(kTube, true));
  EXPECT_FALSE(judge.over());
  judge.take(under(kTube, 5.0), silent(TrackState::kLost, Reason::kJump));
  EXPECT_TRUE(judge.over());
  judge.take_unseen(under(kNext, 6.0));
  judge.take_unseen(under(kNext, 1.0));
  const Counts counts = judge.counts();
  EXPECT_EQ(counts[Count::kFields], 2);
  EXPECT_EQ(counts[Count::kAfterLoss], 2);
  EXPECT_EQ(counts[Count::kMovesLost], 1);
  EXPECT_EQ(counts[Count::kLostJump], 1);
  EXPECT_EQ(counts[Count::kMissed], 1);
  EXPECT_EQ(counts[Count::kMissedLost], 1);
  EXPECT_EQ(counts[Count::kTrulyAligned], 2);
}

TEST(MoveJudge, CountsARefusedStartApartFromLosses) {
  MoveJudge judge(kLimits);
  judge.take(under(kTube, 0.5), silent(TrackState::kWaiting, Reason::kStartRefused));
  EXPECT_TRUE(judge.over());
  EXPECT_EQ(judge.counts()[Count::kMovesRefused], 1);
  EXPECT_EQ(judge.counts()[Count::kMovesLost], 0);
}

TEST(LossCount, KnowsEveryReasonOfALoss) {
  EXPECT_EQ(loss_count(Reason::kNoTubes), Count::kLostNoTubes);
  EXPECT_EQ(loss_count(Reason::kCoasted), Count::kLostCoasted);
  EXPECT_EQ(loss_count(Reason::kGap), Count::kLostGap);
  EXPECT_EQ(loss_count(Reason::kSpeed), Count::kLostSpeed);
  EXPECT_EQ(loss_count(Reason::kTime), Count::kLostTime);
  EXPECT_EQ(loss_count(Reason::kSequence), Count::kLostSequence);
  EXPECT_EQ(loss_count(Reason::kRate), Count::kLostRate);
  EXPECT_EQ(loss_count(Reason::kFieldOrder), Count::kLostFieldOrder);
  EXPECT_EQ(loss_count(Reason::kMap), Count::kLostMap);
  EXPECT_EQ(loss_count(Reason::kArithmetic), Count::kLostArithmetic);
}

}  // namespace
}  // namespace tubesight::board::campaign
