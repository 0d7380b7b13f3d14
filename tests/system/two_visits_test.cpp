// The recording that ./bench.sh replays: what a newcomer sees first.

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/system/csv_rows.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

const std::string kFolder = std::string(TUBESIGHT_TEST_DATA_DIR) + "/recordings/two_visits/";

std::string shipped(const std::string& name) {
  std::ifstream file(kFolder + name, std::ios::binary);
  EXPECT_TRUE(file.good()) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

// Without the comment, which tells where the scenario was read from.
std::string without_comments(const std::string& text) { return text.substr(text.find("[camera]")); }

TEST(TwoVisits, RestsUnderTwoTubesThatTheRobotsClaimsConfirm) {
  const support::TemporaryFolder folder;

  const ProgramRun run = run_tubesight(folder, {"replay", kFolder + "session.toml",
                                                kFolder + "recording.y4m.xz", "--fields", "f.csv"});

  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* line :
       {"tracking        0.933 s  100.00 %", "claims: 2, 2 confirmed, 0 contradicted, 0 unknown",
        "tubes visited: 2"}) {
    EXPECT_NE(run.out.find(line), std::string::npos) << run.out;
  }
  const std::vector<Row> fields = read_rows(folder.read("f.csv"));
  ASSERT_EQ(fields.size(), 56U);
  EXPECT_EQ(fields.front().at("tool_column"), "60");
  EXPECT_EQ(fields.front().at("aligned"), "1");
  EXPECT_EQ(fields.back().at("tool_column"), "61");
  EXPECT_EQ(fields.back().at("aligned"), "1");
}

TEST(TwoVisits, ComesFromTheScenarioBesideIt) {
  const support::TemporaryFolder folder;

  const ProgramRun run =
      run_tubesight(folder, {"simulate", kFolder + "scenario.toml", "--out", "drawn"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(without_comments(folder.read("drawn.session.toml")),
            without_comments(shipped("session.toml")));
  EXPECT_EQ(folder.read("drawn.events.csv"), shipped("recording.events.csv"));
  EXPECT_EQ(folder.read("drawn.meta.csv"), shipped("recording.meta.csv"));
}

}  // namespace
}  // namespace tubesight::tests
