// `tubesight budget` as a user starts it.

#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using support::TemporaryFolder;

constexpr const char* kSession =
    TUBESIGHT_SOURCE_DIR "/tests/data/recordings/square_flush/session.toml";

TEST(Budget, TellsVisionAndChainSideBySide) {
  const TemporaryFolder folder;

  const ProgramRun run =
      run_tubesight(folder, {"budget", kSession, "--robots", "2", "--plot", "p.png"});

  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* const expected :
       {"tool's tip by vision, 40 mm below", "no [camera_quality]", "no [tool_quality]",
        "vision together", "2 lengths", "chain together", "touch, average, standard tool",
        "three touches"}) {
    EXPECT_NE(run.out.find(expected), std::string::npos) << expected << " in\n" << run.out;
  }
  EXPECT_TRUE(folder.read("p.png").starts_with("\x89PNG"));
}

TEST(Budget, CountsWhatTheCalibrationsLeaveUncertain) {
  const TemporaryFolder folder;
  folder.write("s.toml", std::string("include = [\"") + kSession +
                             "\"]\n[tool_quality]\nid = \"x\"\nsigma = [0.3, 0.3, 0.3, 0.0, 0.0, "
                             "0.0]\n");

  const ProgramRun run = run_tubesight(folder, {"budget", "s.toml", "--robots", "1"});

  ASSERT_EQ(run.status, 0) << run.err;
  const std::size_t at = run.out.find("  tool: tip ");
  ASSERT_NE(at, std::string::npos) << run.out;
  EXPECT_NE(run.out.substr(at, 60).find("0.4243    0.3000"), std::string::npos)
      << run.out.substr(at, 60);
}

TEST(Budget, RefusesWhatItCannotCount) {
  const TemporaryFolder folder;
  folder.write("s.toml", "[tubesheet]\nrow_step_mm = [0.0, 25.4]\n");
  const ProgramRun missing = run_tubesight(folder, {"budget", "s.toml"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(missing.err.find("camera: the table is missing"), std::string::npos) << missing.err;
  EXPECT_EQ(run_tubesight(folder, {"budget", kSession, "--robots", "0"}).status, 2);
  EXPECT_EQ(run_tubesight(folder, {"budget", "s.toml", "--plot", "s.toml"}).status, 2);
  const ProgramRun far =
      run_tubesight(folder, {"budget", kSession, "--robots", "1", "--height-mm", "0"});
  EXPECT_EQ(far.status, 0) << far.err;
}

}  // namespace
}  // namespace tubesight::tests
