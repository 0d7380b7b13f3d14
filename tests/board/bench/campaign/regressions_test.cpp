// Every wrong tube that a campaign found, reduced: tests/data/scenarios/regressions.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "board/bench/campaign/move_run.h"
#include "drivers/scenario/scenario_file.h"

namespace tubesight::board::campaign {
namespace {

const std::string kFolder = std::string(TUBESIGHT_TEST_DATA_DIR) + "/scenarios/regressions";

std::vector<std::string> names() {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    found.push_back(entry.path().stem().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

class Regression : public testing::TestWithParam<std::string> {};

TEST_P(Regression, VouchesForNoWrongTube) {
  const auto file = std::make_unique<drivers::ScenarioFile>();
  drivers::Messages messages;
  const auto read =
      drivers::load_scenario(kFolder + "/" + GetParam() + ".toml", {}, *file, messages);
  ASSERT_TRUE(read.has_value()) << (messages.empty() ? "" : messages.front());
  MoveRunner runner;
  const MoveResult result = runner.run(file->scenario, {});
  ASSERT_TRUE(result.runs);
  EXPECT_GT(result.counts[Count::kVouched], 0) << "nothing is tracked: it proves nothing";
  EXPECT_EQ(result.counts[Count::kWrongTube], 0);
  EXPECT_EQ(result.counts[Count::kWrongNearest], 0);
  EXPECT_EQ(result.counts[Count::kFalseAligned], 0);
  // The scenario still holds what it is kept for.
  EXPECT_GT(runner.run(file->scenario, {false, false}).counts[Count::kWrongTube], 0);
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Regression, testing::ValuesIn(names()), test_name);

}  // namespace
}  // namespace tubesight::board::campaign
