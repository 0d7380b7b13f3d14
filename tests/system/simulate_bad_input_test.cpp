// What `simulate` says and leaves when the scenario, an argument or an output is wrong.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/support/replaced_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"
#include "tests/system/scenario_text.h"
#include "tests/system/tiny_replay.h"

namespace tubesight::tests {
namespace {

using support::replaced;
using support::TemporaryFolder;

ProgramRun simulate(const TemporaryFolder& folder) {
  return run_tubesight(folder, {"simulate", "s.toml", "--out", "r"});
}

struct Mistake {
  const char* name;
  const char* right;
  const char* wrong;
  const char* line;
};

class ScenarioMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(ScenarioMistakes, AreRefusedByOneLineBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  folder.write("s.toml", replaced(small_scenario_text(), GetParam().right, GetParam().wrong));

  const ProgramRun run = simulate(folder);

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, std::string(GetParam().line) + "\n");
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"s.toml"});
}

INSTANTIATE_TEST_SUITE_P(
    EachKind, ScenarioMistakes,
    testing::Values(
        Mistake{"UnknownKey", "rest_s = 0.1", "rest_s = 0.1\nspeed = 3",
                "s.toml:29: step[0].speed: unknown key, expected one of claim, claim_tube, rest_s"},
        Mistake{"UnknownTable", "[path]", "[paths]\n[path]",
                "s.toml:24: [paths]: unknown table, expected one of scenario, camera, tool, "
                "tubesheet, start, motion, edges, verification, calibration_error, sheet, look, "
                "lamp, sensor, guidetube, video, path, step, event, fault, robot, expect"},
        Mistake{"NoTube", "tube = [40, 60]", "tube = [40, 160]",
                "s.toml:25: path.tube: tube (40, 160) is outside the tubesheet, expected a row "
                "from 0 to "
                "120 and a column from 0 to 120"},
        Mistake{"PathLeavesTheSheet", "rest_s = 0.1", "to_mm = [1524.0, 3100.0]",
                "s.toml:28: step[0].to_mm: (1524, 3100) mm is off the sheet, at row 122.05 and "
                "column 60, expected a row from 0 to 120 and a column from 0 to 120"},
        Mistake{"ImpossibleHeight", "height_mm = 60", "height_mm = -3",
                "s.toml:26: path.height_mm: -3, expected a number from 0 to 300 mm"},
        Mistake{"FaultAfterTheEnd", "at_s = 0.05", "at_s = 0.5",
                "s.toml:31: fault[0].at_s: after the recording's end, expected within the "
                "recording's 100 ms"},
        Mistake{"FaultEndsAfterTheEnd", "for_s = 0.02", "for_s = 0.06",
                "s.toml:32: fault[0].for_s: ends after the recording, expected within the "
                "recording's 100 ms"},
        Mistake{
            "NoSuchFault", "\"black\"", "\"grey\"",
            "s.toml:30: fault[0].kind: the text 'grey', expected \"dropped\" or \"repeated\" or "
            "\"torn\" or \"swapped\" or \"black\" or \"saturated\" or \"signal-loss\" or "
            "\"knock\" or \"lamp-out\" or \"lamps-dead\" or \"lamp-drift\" or \"vibration\" or "
            "\"cut\" or \"jump\" or \"emi\" or \"salt-pepper\" or \"frozen\" or "
            "\"other-camera\" or \"skip\" or \"pose-step\" or \"held\" or \"compressed\" or "
            "\"jitter\" or \"blots\" or \"reflections\" or \"ghost\" or \"black-level\" or "
            "\"covered\""},
        Mistake{"ParameterOfAnotherFault", "for_s = 0.02", "for_s = 0.02\nangle_deg = 0.1",
                "s.toml:33: fault[0].angle_deg: unknown key, expected one of at_s, for_s, kind, "
                "level"},
        Mistake{"NothingInSight", "[40, 36, 595, 330]", "[286, 400, 351, 470]",
                "s.toml:22: start: fewer than three open tube-ends stand wholly in window_px then, "
                "expected another window, height or tool"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

TEST(Simulate, NamesNoLineOfAFileThatIsNotThere) {
  const TemporaryFolder folder;

  EXPECT_EQ(simulate(folder).err, "s.toml: cannot be read: No such file or directory\n");
}

TEST(Simulate, SaysNothingOfTablesThatAFailedIncludeMayHold) {
  const TemporaryFolder folder;
  for (const char* const include :
       {"include = [\"gone.toml\"]\n", "include = \"gone.toml\"\n", "include = [7]\n"}) {
    folder.write("s.toml", include);

    const ProgramRun run = simulate(folder);

    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(lines_of(run.err), 1) << run.err;
  }
}

TEST(Simulate, TellsAllMistakesAtOnce) {
  const TemporaryFolder folder;
  std::string text = replaced(small_scenario_text(), "bore_mm = 18.6", "bore_mm = 1860");
  text = replaced(text, "rest_s = 0.1", "rest_s = -1");
  text = replaced(text, "\"black\"", "\"grey\"");
  folder.write("s.toml", text);

  const ProgramRun run = simulate(folder);

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(lines_of(run.err), 2) << run.err;  // where the steps lead needs a sheet
  EXPECT_EQ(folder.names(), std::vector<std::string>{"s.toml"});
}

/// Files of this process and those it starts grow to so many bytes at most while it lives.
class LargestFile {
 public:
  explicit LargestFile(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  }
  LargestFile(const LargestFile&) = delete;
  LargestFile& operator=(const LargestFile&) = delete;
  ~LargestFile() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(Simulate, EndsInOneLineWithoutFilesWhenTheVideoFindsNoRoom) {
  const TemporaryFolder folder;
  folder.write("s.toml", small_scenario_text());
  ProgramRun run;
  {
    const LargestFile limit(400000);  // a frame and a bit
    run = simulate(folder);
  }

  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err, "r.y4m: cannot be written: File too large\n");
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"s.toml"});
}

TEST(Simulate, PutsNoFileInPlaceWhenAnotherFindsNoRoom) {
  const TemporaryFolder folder;
  folder.write("s.toml", small_scenario_text());
  std::filesystem::create_symlink("/dev/full", folder.path("r.truth.csv"));

  const ProgramRun run = simulate(folder);

  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err, "r.truth.csv: cannot be written: No space left on device\n");
  EXPECT_EQ(folder.names().size(), 2U) << "the scenario and the link";
}

TEST(Simulate, RefusesToWriteOverItsScenario) {
  const TemporaryFolder folder;
  folder.write("r.session.toml", small_scenario_text());

  const ProgramRun run = run_tubesight(folder, {"simulate", "r.session.toml", "--out", "r"});

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(
      run.err,
      "--out: 'r.session.toml' is also a file of the scenario, expected a place of its own\n");
  EXPECT_EQ(folder.read("r.session.toml"), small_scenario_text());
}

TEST(Simulate, RefusesAFolderThatIsNotThere) {
  const TemporaryFolder folder;
  folder.write("s.toml", small_scenario_text());

  const ProgramRun run = run_tubesight(folder, {"simulate", "s.toml", "--out", "no/r"});

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, "no/r.y4m: cannot be written: No such file or directory\n");
}

TEST(Simulate, RefusesArgumentsInOneLine) {
  const TemporaryFolder folder;
  folder.write("s.toml", small_scenario_text());
  const std::vector<std::vector<std::string>> wrong = {
      {"simulate"},
      {"simulate", "s.toml"},
      {"simulate", "s.toml", "--out"},
      {"simulate", "s.toml", "--out", "r", "--seed", "-1"},
      {"simulate", "s.toml", "--out", "r", "--seed", "x"},
      {"simulate", "s.toml", "--out", ""},
      {"simulate", "no.toml", "--out", "r"},
  };
  for (const auto& arguments : wrong) {
    const ProgramRun run = run_tubesight(folder, arguments);

    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(lines_of(run.err), 1) << run.err;
  }
  EXPECT_EQ(folder.names().size(), 1U);
}

}  // namespace
}  // namespace tubesight::tests
