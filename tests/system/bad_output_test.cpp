// What the program says and leaves when an output or an argument is wrong.

#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"
#include "tests/system/tiny_replay.h"
#include "tests/system/tiny_session.h"

namespace tubesight::tests {
namespace {

using support::TemporaryFolder;

TEST(Replay, FailsInOneLineWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());

  for (const char* const option : {"--fields", "--centers"}) {
    const ProgramRun run =
        run_tubesight(folder, {"replay", "s.toml", "r.y4m", option, "/dev/full"});

    EXPECT_EQ(run.status, 1) << option;
    EXPECT_EQ(run.err, "/dev/full: cannot be written: No space left on device\n") << option;
    EXPECT_EQ(run.out, "") << option;
  }
}

TEST(Replay, LeavesNoOtherOutputBehindWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());

  const ProgramRun run = run_tubesight(
      folder, {"replay", "s.toml", "r.y4m", "--fields", "/dev/full", "--centers", "c.csv"});

  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(folder.names().size(), 2U);
}

TEST(Replay, KeepsAnEarlierResultWhenTheRecordingIsRefused) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", "no recording\n");
  folder.write("f.csv", "of yesterday\n");

  const ProgramRun run = replay(folder, "r.y4m");

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(folder.read("f.csv"), "of yesterday\n");
}

TEST(Replay, RefusesAnOutputInAFolderThatIsNotThere) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());

  const ProgramRun run =
      run_tubesight(folder, {"replay", "s.toml", "r.y4m", "--fields", "no/f.csv"});

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, "no/f.csv: cannot be written: No such file or directory\n");
}

TEST(Replay, RefusesToWriteOverWhatItReads) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());

  const ProgramRun run = run_tubesight(folder, {"replay", "s.toml", "r.y4m", "--overlay", "r.y4m"});

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, "--overlay: 'r.y4m' is also the recording, expected a place of its own\n");
  EXPECT_EQ(folder.read("r.y4m"), recording());
}

TEST(CommandLine, RefusesInOneLine) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"track"},
      {"replay"},
      {"replay", "s.toml"},
      {"replay", "s.toml", "r.y4m", "more"},
      {"replay", "s.toml", "r.y4m", "--scalar", "half"},
      {"replay", "s.toml", "r.y4m", "--overlay-estimates"},
      {"replay", "s.toml", "r.y4m", "--fields"},
      {"--unknown"},
  };
  for (const auto& arguments : wrong) {
    const ProgramRun run = run_tubesight(folder, arguments);

    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(lines_of(run.err), 1) << run.err;
    EXPECT_TRUE(run.err.starts_with("tubesight: ")) << run.err;
  }
}

TEST(CommandLine, TellsItsVersionAndItsArguments) {
  const TemporaryFolder folder;

  const ProgramRun version = run_tubesight(folder, {"--version"});
  const ProgramRun help = run_tubesight(folder, {"replay", "--help"});

  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(std::regex_match(
      version.out,
      std::regex("tubesight " TUBESIGHT_VERSION "\n"
                 "commit (unknown|[A-Za-z0-9._/+-]*[0-9a-f]{7,}(-dirty)?)\n"
                 "arithmetic fixed point, bits before and after it: pixels 16\\.16, millimetres "
                 "12\\.20, rotations 2\\.30, image plane 3\\.29\n")))
      << version.out;
  EXPECT_EQ(help.status, 0);
  for (const char* const word : {"SESSION.toml", "RECORDING", "--fields", "--centers", "--overlay",
                                 "--overlay-estimates", "--scalar"}) {
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace tubesight::tests
