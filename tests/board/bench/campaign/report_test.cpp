#include "board/bench/campaign/report.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "board/bench/campaign/report_groups.h"

namespace tubesight::board::campaign {
namespace {

Progress two_rounds() {
  Progress progress({"0.1.0-abc", "design-1"});
  for (std::int64_t move = 0; move < 2 * kStrata; ++move) {
    Counts counts;
    counts[Count::kMoves] = 1;
    counts[Count::kFields] = 75;
    counts[Count::kTrulyAligned] = 20;
    const bool faulty = stratum_at(stratum_of_move(move)).fault != FaultGroup::kNone;
    counts[Count::kMissed] = faulty ? 5 : 1;
    counts[Count::kMovesLost] = faulty ? 1 : 0;
    counts[Count::kLostJump] = faulty ? 1 : 0;
    progress.add(1, move, counts, 250);
  }
  return progress;
}

const ReportGroup* find(const std::vector<ReportGroup>& groups, const std::string& name) {
  for (const ReportGroup& group : groups) {
    if (group.name == name) {
      return &group;
    }
  }
  return nullptr;
}

TEST(ReportGroups, SumUpTheirStrata) {
  const auto groups = report_groups(two_rounds(), true);
  // 96 strata twice; five and four groups of faults of the six.
  for (const auto& [name, moves] : {std::pair{"all", 192},
                                    {"within_motion", 160},
                                    {"within_motion steady", 128},
                                    {"clear", 32},
                                    {"clear flush", 16},
                                    {"pitch=square", 96},
                                    {"fault=jump", 32},
                                    {"speed=fast", 96},
                                    {"triangular/turned/fillet/jump/fast", 2}}) {
    const ReportGroup* const group = find(groups, name);
    ASSERT_NE(group, nullptr) << name;
    EXPECT_EQ(group->counts[Count::kMoves], moves) << name;
    EXPECT_EQ(group->counts[Count::kFields], 75 * moves) << name;
  }
  EXPECT_EQ(groups.size(), 1U + 2U + 2U * 4U + 6U + 3U + 96U);
}

TEST(ReportText, TellsTotalsAndBoundsPerMove) {
  const std::string text = report_text(two_rounds());
  EXPECT_NE(text.find("seed 1: moves 0 to 191"), std::string::npos) << text;
  EXPECT_NE(text.find("192 moves, 14400 fields seen by the box"), std::string::npos) << text;
  // Nothing in 192: 1 - 0.025^(1/192) = 1.9030 %.
  EXPECT_NE(text.find("0.0000 % (0.0000 to 1.9030 %)"), std::string::npos) << text;
  EXPECT_NE(text.find("96 strata; the smallest has 2 moves, 1.04 % of all"), std::string::npos);
  EXPECT_NE(text.find("lost_jump 160"), std::string::npos);
}

TEST(ReportText, TellsEachReasonOfALoss) {
  Counts counts;
  counts[Count::kMoves] = 1;
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < kCounts; ++i) {
    const auto count = static_cast<Count>(i);
    if (name_of(count).starts_with("lost_")) {
      counts[count] = 1;
      reasons.emplace_back(name_of(count));
    }
  }
  Progress progress({"0.1.0-abc", "design-1"});
  progress.add(1, 0, counts, 250);

  const std::string text = report_text(progress);

  EXPECT_EQ(reasons.size(), 11U);
  for (const std::string& reason : reasons) {
    EXPECT_NE(text.find(" " + reason + " 1"), std::string::npos) << reason;
  }
}

TEST(ReportCsv, HasOneRowAGroupAndAsManyCellsEverywhere) {
  const std::string csv = report_csv(two_rounds());
  std::size_t rows = 0;
  std::size_t commas = 0;
  for (std::size_t from = 0; from < csv.size(); ++rows) {
    const std::size_t to = csv.find('\n', from);
    const auto here =
        static_cast<std::size_t>(std::count(csv.begin() + static_cast<std::ptrdiff_t>(from),
                                            csv.begin() + static_cast<std::ptrdiff_t>(to), ','));
    commas = rows == 0 ? here : commas;
    EXPECT_EQ(here, commas) << rows;
    from = to + 1;
  }
  EXPECT_EQ(rows, 1 + report_groups(two_rounds(), true).size());
  EXPECT_NE(csv.find("\nclear,32,2400,"), std::string::npos);
}

}  // namespace
}  // namespace tubesight::board::campaign
