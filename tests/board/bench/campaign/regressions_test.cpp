// Every wrong tube that a campaign found: tests/data/scenarios/regressions. Of those that other
// rules than the margin keep from it, in `other-rules`, nothing shows here that they would be wrong
// without.

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

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder + folder)) {
    if (entry.is_regular_file()) {
      found.push_back(folder + "/" + entry.path().stem().string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

class Regression : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    drivers::Messages messages;
    const auto read = drivers::load_scenario(kFolder + GetParam() + ".toml", {}, *file_, messages);
    ASSERT_TRUE(read.has_value()) << (messages.empty() ? "" : messages.front());
  }
  void expect_no_wrong_tube() {
    const MoveResult result = runner_.run(file_->scenario, {});
    ASSERT_TRUE(result.runs);
    EXPECT_GT(result.counts[Count::kVouched], 0) << "nothing is tracked: it proves nothing";
    EXPECT_EQ(result.counts[Count::kWrongTube], 0);
    EXPECT_EQ(result.counts[Count::kWrongNearest], 0);
    EXPECT_EQ(result.counts[Count::kFalseAligned], 0);
  }

  std::unique_ptr<drivers::ScenarioFile> file_ = std::make_unique<drivers::ScenarioFile>();
  MoveRunner runner_;
};

TEST_P(Regression, VouchesForNoWrongTube) {
  expect_no_wrong_tube();
  // The scenario still holds what it is kept for.
  EXPECT_GT(runner_.run(file_->scenario, {false, false}).counts[Count::kWrongTube], 0);
}

class OtherRegression : public Regression {};

TEST_P(OtherRegression, VouchesForNoWrongTube) { expect_no_wrong_tube(); }

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  name = name.substr(name.rfind('/') + 1);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Regression, testing::ValuesIn(names_in("")), test_name);
INSTANTIATE_TEST_SUITE_P(All, OtherRegression, testing::ValuesIn(names_in("/other-rules")),
                         test_name);

}  // namespace
}  // namespace tubesight::board::campaign
