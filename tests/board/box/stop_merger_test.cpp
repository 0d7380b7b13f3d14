#include "board/box/stop_merger.h"

#include <chrono>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using std::chrono::seconds;
using Kind = JournalNote::Kind;
using Part = JournalEntry::Part;

JournalNote claim(std::int64_t at_s, core::TubeAddress claimed,
                  core::ClaimVerdict verdict = core::ClaimVerdict::kConfirmed) {
  JournalNote note;
  note.at = seconds(at_s);
  note.claim.claimed = claimed;
  note.claim.tube = claimed;
  note.claim.verdict = verdict;
  return note;
}

JournalNote other(Kind kind, std::int64_t at_s) {
  JournalNote note;
  note.kind = kind;
  note.at = seconds(at_s);
  return note;
}

class StopMergerTest : public ::testing::Test {
 protected:
  void take(const JournalNote& note) { merger_.take(note, rows_); }
  [[nodiscard]] std::int64_t claims_told() const {
    std::int64_t sum = 0;
    for (const JournalEntry& row : rows_) {
      sum += row.note.kind == Kind::kClaim ? row.count : 0;
    }
    return sum;
  }

  StopMerger merger_;
  std::vector<JournalEntry> rows_;
};

constexpr core::TubeAddress kTube{40, 61};
constexpr core::TubeAddress kNext{40, 62};

TEST_F(StopMergerTest, TheFirstClaimIsARowAtOnceAndTheOthersOneAtTheEnd) {
  take(claim(1, kTube));
  ASSERT_EQ(rows_.size(), 1U);
  EXPECT_EQ(rows_[0].part, Part::kFirst);
  take(claim(2, kTube));
  take(claim(3, kTube));
  EXPECT_EQ(rows_.size(), 1U);

  take(claim(5, kNext));

  ASSERT_EQ(rows_.size(), 3U);
  EXPECT_EQ(rows_[1].part, Part::kEnd);
  EXPECT_EQ(rows_[1].stop, rows_[0].stop);
  EXPECT_EQ(rows_[1].first, seconds(1));
  EXPECT_EQ(rows_[1].last, seconds(3));
  EXPECT_EQ(rows_[1].count, 2);
  EXPECT_EQ(rows_[2].note.claim.claimed, kNext);
  EXPECT_EQ(rows_[2].stop, rows_[0].stop + 1);
  EXPECT_EQ(claims_told(), 4);
}

TEST_F(StopMergerTest, AStopOfOneClaimIsOneRow) {
  take(claim(1, kTube));
  merger_.end(rows_);
  merger_.end(rows_);

  EXPECT_EQ(rows_.size(), 1U);
}

TEST_F(StopMergerTest, AnotherAnswerToTheSameClaimIsARowAtOnce) {
  take(claim(1, kTube));
  take(claim(2, kTube));
  JournalNote contradicted = claim(3, kTube, core::ClaimVerdict::kContradicted);
  contradicted.claim.tube = kNext;
  take(contradicted);
  JournalNote elsewhere = contradicted;
  elsewhere.claim.tube = {41, 62};
  take(elsewhere);

  ASSERT_EQ(rows_.size(), 4U);
  EXPECT_EQ(rows_[1].part, Part::kEnd);
  EXPECT_EQ(rows_[2].note.claim.verdict, core::ClaimVerdict::kContradicted);
  EXPECT_EQ(rows_[3].note.claim.tube, (core::TubeAddress{41, 62}));
  EXPECT_EQ(claims_told(), 4);
}

TEST_F(StopMergerTest, UnknownAnswersAreEqualWhateverStandsInTheirTube) {
  JournalNote unknown = claim(1, kTube, core::ClaimVerdict::kUnknown);
  take(unknown);
  unknown.claim.tube = kNext;
  take(unknown);
  EXPECT_EQ(rows_.size(), 1U);

  unknown.claim.doubt = core::ClaimDoubt::kMoving;
  take(unknown);
  EXPECT_EQ(rows_.size(), 3U) << "for another reason";
}

TEST_F(StopMergerTest, StartLossAndGapEndAStopAndStandBehindItsRow) {
  for (const Kind kind : {Kind::kStart, Kind::kLoss, Kind::kGap}) {
    merger_.end(rows_);  // the stop of the kind before
    rows_.clear();
    take(claim(1, kTube));
    take(claim(2, kTube));
    take(other(kind, 3));

    ASSERT_EQ(rows_.size(), 3U);
    EXPECT_EQ(rows_[1].part, Part::kEnd);
    EXPECT_EQ(rows_[2].note.kind, kind);
    take(claim(4, kTube));
    EXPECT_EQ(rows_.size(), 4U) << "a stop of its own";
  }
}

TEST_F(StopMergerTest, AToolThatLeftAndCameBackStopsAnew) {
  take(claim(1, kTube));
  take(other(Kind::kLeft, 2));
  EXPECT_EQ(rows_.size(), 1U) << "leaving is no row";
  take(claim(3, kTube));

  ASSERT_EQ(rows_.size(), 2U);
  EXPECT_EQ(rows_[1].part, Part::kFirst);
  EXPECT_NE(rows_[1].stop, rows_[0].stop);
}

TEST_F(StopMergerTest, APoseBetweenEndsNothing) {
  take(claim(1, kTube));
  take(other(Kind::kPose, 2));
  take(claim(3, kTube));
  ASSERT_EQ(rows_.size(), 2U);

  merger_.end(rows_);

  ASSERT_EQ(rows_.size(), 3U);
  EXPECT_EQ(rows_[2].stop, rows_[0].stop);
}

TEST_F(StopMergerTest, SilenceEndsAStopAndNotBefore) {
  take(claim(1, kTube));
  take(claim(2, kTube));
  merger_.look(seconds(11), rows_);
  EXPECT_EQ(rows_.size(), 1U);
  merger_.look(seconds(12), rows_);
  ASSERT_EQ(rows_.size(), 2U);
  EXPECT_EQ(rows_[1].last, seconds(2));

  take(claim(20, kTube));
  take(claim(30, kTube));
  EXPECT_EQ(rows_.size(), 4U) << "nobody looked in between";
}

TEST_F(StopMergerTest, ALongStopIsToldOfEachMinute) {
  for (std::int64_t s = 0; s <= 150; ++s) {
    take(claim(s, kTube));
  }
  ASSERT_EQ(rows_.size(), 3U);
  EXPECT_EQ(rows_[1].part, Part::kOn);
  EXPECT_EQ(rows_[1].last, seconds(60));
  EXPECT_EQ(rows_[2].first, seconds(0));
  EXPECT_EQ(rows_[2].last, seconds(120));

  merger_.end(rows_);

  EXPECT_EQ(rows_[3].part, Part::kEnd);
  EXPECT_EQ(rows_[3].last, seconds(150));
  EXPECT_EQ(claims_told(), 151);
}

}  // namespace
}  // namespace tubesight::board
