#include "board/bench/campaign/progress.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"

namespace tubesight::board::campaign {
namespace {

using support::replaced;

const CampaignIdentity kIdentity{"0.1.0-abc", "design-1"};

Counts some_counts(std::int64_t fields) {
  Counts counts;
  counts[Count::kMoves] = 1;
  counts[Count::kFields] = fields;
  return counts;
}

Progress moves(std::uint64_t seed, std::int64_t first, std::int64_t end) {
  Progress progress(kIdentity);
  for (std::int64_t move = first; move < end; ++move) {
    progress.add(seed, move, some_counts(10 + move), 5);
  }
  return progress;
}

TEST(Progress, AddsMovesToTheirStrata) {
  const Progress progress = moves(1, 94, 98);
  ASSERT_EQ(progress.ranges().size(), 1U);
  EXPECT_EQ(progress.ranges()[0].first, 94);
  EXPECT_EQ(progress.ranges()[0].end, 98);
  EXPECT_EQ(progress.busy_ms(), 20);
  EXPECT_EQ(progress.strata()[95][Count::kFields], 105);
  EXPECT_EQ(progress.strata()[0][Count::kFields], 106);
  EXPECT_EQ(progress.total()[Count::kMoves], 4);
}

TEST(Progress, ReadsBackWhatItWrites) {
  Progress progress = moves(1, 0, 3);
  std::string why;
  ASSERT_TRUE(progress.absorb(moves(1, 7, 9), why)) << why;
  ASSERT_TRUE(progress.absorb(moves(2, 0, 1), why)) << why;
  Progress read;
  ASSERT_TRUE(read.parse(progress.text(), "p.csv", why)) << why;
  EXPECT_EQ(read.text(), progress.text());
  EXPECT_TRUE(read.identity() == kIdentity);
  EXPECT_EQ(read.ranges().size(), 3U);
  EXPECT_EQ(read.total()[Count::kFields], progress.total()[Count::kFields]);
}

TEST(Progress, TellsTheNextMoveToDo) {
  Progress progress = moves(1, 0, 3);
  std::string why;
  ASSERT_TRUE(progress.absorb(moves(1, 5, 6), why)) << why;
  EXPECT_EQ(progress.next_move(1, 0), 3);
  EXPECT_EQ(progress.next_move(1, 4), 4);
  EXPECT_EQ(progress.next_move(1, 5), 6);
  EXPECT_EQ(progress.next_move(9, 0), 0);
}

TEST(Progress, JoinsRangesThatMeet) {
  Progress progress = moves(1, 3, 6);
  std::string why;
  ASSERT_TRUE(progress.absorb(moves(1, 0, 3), why)) << why;
  ASSERT_EQ(progress.ranges().size(), 1U);
  EXPECT_EQ(progress.text(), moves(1, 0, 6).text());
}

TEST(Progress, RefusesAMoveInBoth) {
  Progress progress = moves(1, 0, 4);
  std::string why;
  EXPECT_FALSE(progress.absorb(moves(1, 3, 5), why));
  EXPECT_EQ(why, "move 3 of seed 1 is in two files, expected each move once");
}

TEST(Progress, RefusesAnotherBoxOrConfiguration) {
  Progress progress = moves(1, 0, 1);
  std::string why;
  Progress other({"0.1.0-abd", "design-1"});
  EXPECT_FALSE(progress.absorb(other, why));
  EXPECT_EQ(why,
            "it is of box 0.1.0-abd and configuration design-1, expected 0.1.0-abc and design-1");
  EXPECT_FALSE(progress.absorb(Progress({"0.1.0-abc", "design-2"}), why));
}

std::string refusal(const std::string& text) {
  Progress progress;
  std::string why;
  EXPECT_FALSE(progress.parse(text, "p.csv", why));
  EXPECT_EQ(why.find('\n'), std::string::npos) << why;
  return why;
}

/// `text` with all of `from` as `to`.
std::string replaced_everywhere(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// Moves 1 to 49 would never be run.
TEST(Progress, RefusesARangeThatItsCountsDoNotFill) {
  const std::string good = moves(1, 0, 1).text();
  ASSERT_NE(good.find(",design-1,1,0,1,5,"), std::string::npos);
  EXPECT_EQ(refusal(replaced_everywhere(good, ",design-1,1,0,1,5,", ",design-1,1,0,50,5,")),
            "p.csv: moves 0 to 49: stratum triangular/upright/flush/none/slow has 0 moves, "
            "expected 1");
  // A hundred moves: two of the strata 94, 95, 0 and 1, one of each other.
  Progress progress;
  std::string why;
  const std::string round = moves(3, 94, 194).text();
  EXPECT_TRUE(progress.parse(round, "p.csv", why)) << why;
  EXPECT_NE(refusal(replaced_everywhere(round, ",design-1,3,94,194,", ",design-1,3,93,194,"))
                .find("moves 93 to 193: stratum triangular/upright/fillet/jump/fast has 1 moves, "
                      "expected 2"),
            std::string::npos);
}

TEST(Progress, RefusesRowsOfARangeThatDisagree) {
  const std::string good = moves(1, 0, 1).text();
  const std::string second = "1,0,1,5,triangular/upright/flush/none/slow";
  EXPECT_NE(refusal(replaced(good, second, "1,0,2,5,triangular/upright/flush/none/slow"))
                .find("p.csv:3: end_move or busy_ms differ"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(good, second, "1,0,1,6,triangular/upright/flush/none/slow"))
                .find("p.csv:3: end_move or busy_ms differ"),
            std::string::npos);
}

TEST(Progress, RefusesWhatIsNoWholeFile) {
  const std::string good = moves(1, 0, 2).text();
  EXPECT_NE(refusal("").find("p.csv"), std::string::npos);
  EXPECT_EQ(refusal("a,b\n1,2\n").find("p.csv: not a progress file of tubesight campaign"), 0U);
  EXPECT_EQ(refusal(good.substr(0, good.find('\n') + 1)), "p.csv: no moves in it");
  EXPECT_NE(refusal(good.substr(0, good.size() / 2)).find("p.csv"), std::string::npos);
  // A whole row less: the sum shows it.
  EXPECT_NE(refusal(good.substr(0, good.rfind("1,0.1.0"))).find("do not add up"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(good, "square/upright", "round/upright")).find("is not known"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(good, ",1,10,", ",1,11,")).find("do not add up"), std::string::npos);
  EXPECT_NE(refusal(replaced(good, ",1,10,", ",-1,10,")).find("whole numbers"), std::string::npos);
}

}  // namespace
}  // namespace tubesight::board::campaign
