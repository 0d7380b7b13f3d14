#include "board/bench/reconcile/journal_evidence.h"

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using Kind = Evidence::Kind;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::int64_t kSecond_us = 1'000'000;

/// A row that was made so many seconds after the machine's start, at 1,000,000 s by the wall clock.
drivers::JournalEntry row(std::int64_t number, const char* kind, std::int64_t second) {
  drivers::JournalEntry entry;
  entry.number = number;
  entry.kind = kind;
  entry.boot_id = "b";
  entry.monotonic_us = second * kSecond_us;
  entry.wall_us = (1'000'000 + second) * kSecond_us;
  entry.wall_doubt_us = 49'000;
  return entry;
}

drivers::JournalEntry confirmed(std::int64_t number, std::int64_t first, std::int64_t last) {
  drivers::JournalEntry entry = row(number, "verification", last);
  entry.verdict = "confirmed";
  entry.claimed = core::TubeAddress{40, 60};
  entry.tube = entry.claimed;
  entry.first_us = first * kSecond_us;
  entry.last_us = last * kSecond_us;
  return entry;
}

UtcTime at(std::int64_t second) { return UtcTime(seconds(1'000'000 + second)); }

TEST(JournalEvidenceTest, AStopIsFromItsFirstClaimToItsLast) {
  JournalEvidence gathered;
  gathered.add(confirmed(2, 10, 25));
  const auto evidence = gathered.take(2);
  ASSERT_EQ(evidence.size(), 1U);
  EXPECT_EQ(evidence[0].kind, Kind::kConfirmed);
  EXPECT_EQ(evidence[0].first, at(10));
  EXPECT_EQ(evidence[0].last, at(25));
  EXPECT_EQ(evidence[0].doubt, milliseconds(50));
  EXPECT_TRUE(evidence[0].trusted);
}

TEST(JournalEvidenceTest, RowsBehindTheLastSignatureAreNotTrusted) {
  JournalEvidence gathered;
  gathered.add(confirmed(2, 10, 10));
  gathered.add(confirmed(3, 20, 20));
  const auto evidence = gathered.take(2);
  ASSERT_EQ(evidence.size(), 2U);
  EXPECT_TRUE(evidence[0].trusted);
  EXPECT_FALSE(evidence[1].trusted);
}

TEST(JournalEvidenceTest, WhatElseHappensEndsWhatWasConfirmed) {
  for (const char* const kind :
       {"boot", "loss", "fault", "setting", "begin", "of a later version"}) {
    JournalEvidence gathered;
    gathered.add(row(2, kind, 10));
    const auto evidence = gathered.take(2);
    ASSERT_EQ(evidence.size(), 1U) << kind;
    EXPECT_EQ(evidence[0].kind, Kind::kBroken) << kind;
  }
  for (const char* const kind : {"pose", "acknowledgement"}) {
    JournalEvidence gathered;
    gathered.add(row(2, kind, 10));
    EXPECT_TRUE(gathered.take(2).empty()) << kind;
  }
}

TEST(JournalEvidenceTest, AStartEndsItWhenItWasTaken) {
  for (const bool taken : {true, false}) {
    drivers::JournalEntry start = row(2, "start", 10);
    start.verdict = taken ? "taken" : "refused";
    JournalEvidence gathered;
    gathered.add(start);
    EXPECT_EQ(gathered.take(2).size(), taken ? 1U : 0U);
  }
}

TEST(JournalEvidenceTest, ARowThatContradictsItselfVouchesForNothing) {
  drivers::JournalEntry odd = confirmed(2, 10, 10);
  odd.tube = core::TubeAddress{40, 61};
  JournalEvidence gathered;
  gathered.add(odd);
  EXPECT_EQ(gathered.take(2)[0].kind, Kind::kUnknown);
}

TEST(JournalEvidenceTest, AClockInUnknownDoubtIsBoundByItsNeighboursAlone) {
  drivers::JournalEntry unknown = confirmed(3, 20, 20);
  unknown.wall_doubt_us.reset();
  JournalEvidence gathered;
  gathered.add(row(2, "boot", 10));
  gathered.add(unknown);
  gathered.add(row(4, "boot", 30));
  const auto evidence = gathered.take(4);
  ASSERT_EQ(evidence.size(), 3U);
  EXPECT_GE(evidence[1].doubt, seconds(10));
  EXPECT_LE(evidence[1].doubt, seconds(11));
}

TEST(JournalEvidenceTest, SomebodyWhoComparedTheClockMaySayItsDoubt) {
  drivers::JournalEntry unknown = confirmed(2, 20, 20);
  unknown.wall_doubt_us.reset();
  JournalEvidence gathered(milliseconds(499));
  gathered.add(unknown);
  const auto evidence = gathered.take(2);
  EXPECT_EQ(evidence[0].doubt, milliseconds(500));
  EXPECT_EQ(evidence[0].last, at(20));
}

TEST(JournalEvidenceTest, AWallClockThatIsSetBetweenRowsMovesNoneBehindAnother) {
  drivers::JournalEntry set_back = confirmed(3, 20, 20);
  *set_back.wall_us -= 3600 * kSecond_us;
  set_back.wall_doubt_us.reset();
  JournalEvidence gathered;
  gathered.add(confirmed(2, 10, 10));
  gathered.add(set_back);
  const auto evidence = gathered.take(3);
  ASSERT_EQ(evidence.size(), 2U);
  EXPECT_EQ(evidence[0].row, 2);
  EXPECT_GE(evidence[1].last + evidence[1].doubt, at(10));
}

}  // namespace
}  // namespace tubesight::board
