// Jobs at both ends of a tube against what the boxes vouched for. The accidents are those of the
// trade.

#include "board/bench/reconcile/reconciliation.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "board/bench/reconcile/reconciliation_text.h"

namespace tubesight::board {
namespace {

using core::TubeAddress;
using std::chrono::milliseconds;
using std::chrono::seconds;

UtcTime at(int second) { return UtcTime(seconds(1'000'000 + second)); }

Evidence confirmed(TubeAddress tube, int first, int last, int row = 1) {
  return {Evidence::Kind::kConfirmed, tube, tube, at(first), at(last), milliseconds(0), row};
}

Evidence contradicted(TubeAddress claimed, TubeAddress tube, int second, int row = 2) {
  return {
      Evidence::Kind::kContradicted, claimed, tube, at(second), at(second), milliseconds(0), row};
}

Evidence broken(int second, int row = 3) {
  return {Evidence::Kind::kBroken, {}, {}, at(second), at(second), milliseconds(0), row};
}

Job plug(Leg leg, TubeAddress tube, int second) { return {2, "plug", leg, tube, at(second)}; }

Job planned(Leg leg, TubeAddress tube) { return {2, "plug", leg, tube, {}}; }

JobFinding judged(const std::vector<Evidence>& evidence, const Job& job) {
  return judge_job(job, {evidence, {}}, kHold).finding;
}

const TubeAddress kTube{12, 34};
const TubeAddress kNext{12, 35};
const TubeAddress kOther{20, 40};

TEST(JudgedJobs, AreVouchedForWithinTheConfirmationAndSoonAfterIt) {
  const std::vector<Evidence> evidence = {confirmed(kTube, 10, 20)};

  EXPECT_EQ(judged(evidence, plug(Leg::kHot, kTube, 10)), JobFinding::kVouched);
  EXPECT_EQ(judged(evidence, plug(Leg::kHot, kTube, 30)), JobFinding::kVouched);
  EXPECT_EQ(judged(evidence, plug(Leg::kHot, kTube, 31)), JobFinding::kNotVouched);
  EXPECT_EQ(judged(evidence, plug(Leg::kHot, kTube, 9)), JobFinding::kNotVouched);
  EXPECT_EQ(judged({}, plug(Leg::kHot, kTube, 9)), JobFinding::kNotVouched);
}

TEST(JudgedJobs, AreNotVouchedForBehindALossOrAStart) {
  EXPECT_EQ(judged({confirmed(kTube, 10, 20), broken(21)}, plug(Leg::kHot, kTube, 22)),
            JobFinding::kNotVouched);
}

TEST(JudgedJobs, UnderAnotherTubeAreWrong) {
  const JudgedJob job =
      judge_job(plug(Leg::kHot, kTube, 15), {{confirmed(kNext, 10, 20, 88)}, {}}, kHold);

  EXPECT_EQ(job.finding, JobFinding::kWrongTube);
  EXPECT_EQ(job.seen, kNext);
  EXPECT_EQ(job.row, 88);
}

TEST(JudgedJobs, AgainstAContradictionAreSoHoweverLate) {
  EXPECT_EQ(judged({contradicted(kTube, kNext, 10)}, plug(Leg::kHot, kTube, 500)),
            JobFinding::kContradicted);
  EXPECT_EQ(judged({contradicted(kTube, kNext, 10), confirmed(kTube, 20, 30)},
                   plug(Leg::kHot, kTube, 25)),
            JobFinding::kVouched);
  EXPECT_EQ(judged({contradicted(kTube, kNext, 10)}, plug(Leg::kHot, kOther, 12)),
            JobFinding::kWrongTube);
}

TEST(JudgedJobs, InDoubtOfTheClockMustBeVouchedForWhateverItsError) {
  Evidence good = confirmed(kTube, 10, 20, 1);
  Evidence next = confirmed(kNext, 40, 50, 2);
  good.doubt = next.doubt = seconds(5);

  EXPECT_EQ(judged({good, next}, plug(Leg::kHot, kTube, 16)), JobFinding::kVouched);
  EXPECT_EQ(judged({good, next}, plug(Leg::kHot, kTube, 12)), JobFinding::kNotVouched);
  EXPECT_EQ(judged({good, next}, plug(Leg::kHot, kTube, 26)), JobFinding::kNotVouched);
  EXPECT_EQ(judged({good, next}, plug(Leg::kHot, kTube, 36)), JobFinding::kWrongTube);
}

/// One tube's job, at both ends.
ReconciledTube only(const std::vector<ReconciledTube>& tubes) {
  EXPECT_EQ(tubes.size(), 1U);
  return tubes.empty() ? ReconciledTube{} : tubes[0];
}

TEST(Reconciliation, ClosesATubeWhoseEndsWereBothVouchedFor) {
  const std::vector<Job> jobs = {plug(Leg::kHot, kTube, 15), plug(Leg::kCold, kTube, 115)};
  const std::array<LegRecord, 2> legs = {LegRecord{{confirmed(kTube, 10, 20)}, {}},
                                         LegRecord{{confirmed(kTube, 110, 120)}, {}}};

  EXPECT_EQ(only(reconcile(jobs, legs, kHold)).finding, TubeFinding::kClosed);
  EXPECT_EQ(reconciliation_text(reconcile(jobs, legs, kHold)),
            "0 wrong-end, 0 contradicted, 0 one-end, 0 open, 0 not-vouched, 1 closed\n");
}

TEST(Reconciliation, KnowsTheOtherEndByMirroredNumbers) {
  const std::vector<Job> jobs = {plug(Leg::kHot, kTube, 15), plug(Leg::kCold, {12, 67}, 115)};
  const std::array<LegRecord, 2> legs = {LegRecord{{confirmed(kTube, 10, 20)}, {}},
                                         LegRecord{{confirmed({12, 67}, 110, 120)}, {101}}};

  const ReconciledTube tube = only(reconcile(jobs, legs, kHold));
  EXPECT_EQ(tube.tube, kTube);
  EXPECT_EQ(tube.finding, TubeFinding::kClosed);
}

TEST(Reconciliation, LeavesOpenWhatIsPlannedAndNotDone) {
  const std::array<LegRecord, 2> legs = {LegRecord{{confirmed(kTube, 10, 20)}, {}}, LegRecord{}};
  EXPECT_EQ(only(reconcile(std::vector{plug(Leg::kHot, kTube, 15), planned(Leg::kCold, kTube)},
                           legs, kHold))
                .finding,
            TubeFinding::kOpen);
  EXPECT_EQ(only(reconcile(std::vector{plug(Leg::kHot, kTube, 15), plug(Leg::kCold, kTube, 115)},
                           legs, kHold))
                .finding,
            TubeFinding::kNotVouched);
}

// In 2005 one tube's cold end was plugged and another tube's hot end; found four years later.
TEST(Accidents, OneTubesColdEndAndAnothersHotEnd) {
  // By the robot's own count both were the tube meant; the box of the cold leg saw the other one.
  const std::array<LegRecord, 2> legs = {
      LegRecord{{confirmed(kTube, 10, 20)}, {}},
      LegRecord{{contradicted(kTube, kOther, 110), confirmed(kOther, 112, 120, 7)}, {}}};
  const auto by_count =
      reconcile(std::vector{plug(Leg::kHot, kTube, 15), plug(Leg::kCold, kTube, 115)}, legs, kHold);
  EXPECT_EQ(only(by_count).finding, TubeFinding::kWrongEnd);
  EXPECT_NE(reconciliation_text(by_count).find("UNDER (20, 40), row 7 of the journal"),
            std::string::npos)
      << reconciliation_text(by_count);

  // Where the tube was written down that the box vouched for, both tubes lack an end.
  const auto by_box = reconcile(
      std::vector{plug(Leg::kHot, kTube, 15), plug(Leg::kCold, kOther, 115)}, legs, kHold);
  ASSERT_EQ(by_box.size(), 2U);
  EXPECT_EQ(by_box[0].finding, TubeFinding::kOneEnd);
  EXPECT_EQ(by_box[0].tube, kTube);
  EXPECT_EQ(by_box[0].other_half, kOther);
  EXPECT_EQ(by_box[1].other_half, kTube);
}

TEST(Accidents, TwoTubesPluggedInOneLegOnlyByAWrongCount) {
  const std::array<LegRecord, 2> legs = {
      LegRecord{{contradicted(kTube, kNext, 10), contradicted(kOther, {20, 41}, 50)}, {}},
      LegRecord{{confirmed(kTube, 110, 120), confirmed(kOther, 150, 160)}, {}}};

  const auto tubes =
      reconcile(std::vector{plug(Leg::kHot, kTube, 15), plug(Leg::kHot, kOther, 55),
                            plug(Leg::kCold, kTube, 115), plug(Leg::kCold, kOther, 155)},
                legs, kHold);

  ASSERT_EQ(tubes.size(), 2U);
  for (const ReconciledTube& tube : tubes) {
    EXPECT_EQ(tube.finding, TubeFinding::kContradicted);
    EXPECT_EQ(tube.ends[0][0].finding, JobFinding::kContradicted);
    EXPECT_EQ(tube.ends[1][0].finding, JobFinding::kVouched);
  }
}

TEST(Accidents, ATubePluggedBesideTheOneMeant) {
  const std::array<LegRecord, 2> legs = {LegRecord{{confirmed(kNext, 10, 20, 4)}, {}},
                                         LegRecord{{confirmed(kTube, 110, 120, 9)}, {}}};

  const auto tubes =
      reconcile(std::vector{plug(Leg::kHot, kTube, 15), plug(Leg::kCold, kTube, 115)}, legs, kHold);

  EXPECT_EQ(only(tubes).finding, TubeFinding::kWrongEnd);
  EXPECT_EQ(reconciliation_rows(tubes),
            "plug,12,34,wrong-end,wrong-tube,1970-01-12T13:46:55.000Z,12,35,4,vouched,"
            "1970-01-12T13:48:35.000Z,,,9,,\n");
}

TEST(Reconciliation, ListsTheWorstFirst) {
  const std::array<LegRecord, 2> legs = {
      LegRecord{{confirmed(kTube, 10, 20), confirmed(kNext, 30, 40), confirmed(kOther, 50, 60)},
                {}},
      LegRecord{{confirmed(kTube, 110, 120)}, {}}};

  const auto tubes = reconcile(std::vector{plug(Leg::kHot, kTube, 15), plug(Leg::kCold, kTube, 115),
                                           plug(Leg::kHot, kNext, 35), plug(Leg::kHot, {1, 1}, 55),
                                           planned(Leg::kHot, {2, 2})},
                               legs, kHold);

  ASSERT_EQ(tubes.size(), 4U);
  EXPECT_EQ(tubes[0].finding, TubeFinding::kWrongEnd);
  EXPECT_EQ(tubes[1].finding, TubeFinding::kOneEnd);
  EXPECT_EQ(tubes[2].finding, TubeFinding::kOpen);
  EXPECT_EQ(tubes[3].finding, TubeFinding::kClosed);
}

}  // namespace
}  // namespace tubesight::board
