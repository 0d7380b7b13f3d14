// Every scenario of tests/data/scenarios, played in memory: the box does what the file's [expect]
// says, and never vouches for a wrong tube.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/names.h"
#include "drivers/scenario/scenario_file.h"
#include "tests/system/scenario_judge.h"

namespace tubesight::tests {
namespace {

const std::string kFolder = std::string(TUBESIGHT_TEST_DATA_DIR) + "/scenarios";

std::vector<std::string> library() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".toml") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The file read, its mistakes told by the test.
std::unique_ptr<drivers::ScenarioFile> load(const std::string& name) {
  auto file = std::make_unique<drivers::ScenarioFile>();
  drivers::Messages messages;
  const bool good =
      drivers::load_scenario(kFolder + "/" + name + ".toml", {-1, true}, *file, messages)
          .has_value();
  for (const std::string& message : messages) {
    ADD_FAILURE() << message;
  }
  return good ? std::move(file) : nullptr;
}

class ScenarioLibrary : public testing::TestWithParam<std::string> {};

TEST_P(ScenarioLibrary, GoesAsExpected) {
  const auto file = load(GetParam());
  ASSERT_NE(file, nullptr);

  const ScenarioVerdict verdict = judge_scenario(*file);

  const drivers::Expectation& expect = file->expect;
  SCOPED_TRACE(verdict.text());
  RecordProperty("verdict", verdict.text());
  ASSERT_TRUE(verdict.played);
  EXPECT_EQ(verdict.wrong_tube, 0);
  EXPECT_LE(verdict.false_aligned, expect.false_aligned);
  EXPECT_EQ(verdict.wrong_nearest, 0);
  EXPECT_GE(verdict.answered_share(), expect.answered);
  EXPECT_LE(verdict.missed_share(), expect.missed);
  EXPECT_EQ(verdict.contradicted, expect.contradicted);
  EXPECT_GE(verdict.confirmed, expect.confirmed);
  EXPECT_GE(verdict.tubes.size(), static_cast<std::size_t>(expect.tubes));
  EXPECT_EQ(core::name_of(verdict.end), core::name_of(expect.end));
  EXPECT_EQ(verdict.undetectable > 0, expect.undetectable);
  EXPECT_TRUE(expect.lost == core::Reason::kNone || verdict.lost.contains(expect.lost));
  EXPECT_TRUE(expect.lost != core::Reason::kNone || verdict.lost.empty());
  EXPECT_TRUE(expect.degraded == core::Reason::kNone || verdict.degraded.contains(expect.degraded));
}

std::string test_name(const testing::TestParamInfo<std::string>& scenario) {
  std::string name = scenario.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, ScenarioLibrary, testing::ValuesIn(library()), test_name);

TEST(ScenarioLibraryJudge, FindsWhatIsWrongWhenTheBoxIsToldOfAnotherTube) {
  const auto file = load("rest-square");
  ASSERT_NE(file, nullptr);
  for (core::StartPoint& click : file->scenario.told.start.tubes) {
    click.address.column += 1;
  }

  const ScenarioVerdict verdict = judge_scenario(*file);

  EXPECT_GT(verdict.wrong_tube, 0) << verdict.text();
  EXPECT_GT(verdict.wrong_nearest, 0);
}

TEST(ScenarioLibraryJudge, ExcusesAfterAJumpNothingButItsSteps) {
  const auto file = load("fault-jump");
  ASSERT_NE(file, nullptr);
  for (core::StartPoint& click : file->scenario.told.start.tubes) {
    click.address.row += 1;
  }

  const ScenarioVerdict verdict = judge_scenario(*file);

  // A row off from the first field to the last, and a column too from the jump on.
  EXPECT_EQ(verdict.undetectable, 0) << verdict.text();
  EXPECT_EQ(verdict.end, core::TrackState::kTracking);
  EXPECT_GT(verdict.wrong_nearest, verdict.fields / 2);
}

}  // namespace
}  // namespace tubesight::tests
