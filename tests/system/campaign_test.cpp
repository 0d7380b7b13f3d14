// `tubesight campaign` as a user starts it.

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using support::TemporaryFolder;

class CampaignProgram : public testing::Test {
 protected:
  ProgramRun run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "campaign");
    return run_tubesight(folder_, arguments);
  }
  // One line that names what is wrong.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& about) {
    const ProgramRun refused = run(arguments);
    EXPECT_EQ(refused.status, 2) << refused.err;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_NE(refused.err.find(about), std::string::npos) << refused.err;
    EXPECT_EQ(refused.out, "");
  }

  TemporaryFolder folder_;
};

TEST_F(CampaignProgram, RefusesArgumentsThatMeanNothing) {
  expect_refused({}, "expected a limit (--moves, --fields, --hours); or --merge; or --replay-move");
  expect_refused({"--moves", "5", "--merge", "a.csv"}, "expected a limit");
  expect_refused({"--moves", "0"}, "--moves");
  expect_refused({"--moves", "many"}, "--moves");
  expect_refused({"--hours", "-1"}, "--hours");
  expect_refused({"--hours", "nan"}, "--hours: Value nan not in range");
  expect_refused({"--moves", "1", "--jobs", "0"}, "--jobs");
  expect_refused({"--moves", "1", "--seed", "-4"}, "--seed");
  expect_refused({"--moves", "1", "--out", "a.toml"}, "--out goes with");
  expect_refused({"--moves", "1", "--reduce"}, "--reduce needs --replay-move");
  expect_refused({"--replay-move", "1:2"}, "--replay-move needs --out");
  expect_refused({"--replay-move", "1:2", "--out", "no/such/folder.toml"}, "no/such/folder.toml");
  expect_refused({"--replay-move", "1-2", "--out", "a.toml"}, "expected SEED:MOVE");
  expect_refused({"--replay-move", "1:-2", "--out", "a.toml"}, "expected SEED:MOVE");
}

TEST_F(CampaignProgram, RefusesWhatItWouldPassOver) {
  using Words = std::vector<std::string>;
  for (const Words& option :
       {Words{"--resume", "a.csv"}, Words{"--seed", "1"}, Words{"--first-move", "0"},
        Words{"--jobs", "1"}, Words{"--without-margin-check"}}) {
    Words arguments = {"--merge", "b.csv"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    expect_refused(arguments, option.front() + " does not go with --merge");
  }
  for (const Words& option :
       {Words{"--resume", "a.csv"}, Words{"--seed", "1"}, Words{"--first-move", "0"},
        Words{"--jobs", "1"}, Words{"--report", "r.csv"}}) {
    Words arguments = {"--replay-move", "1:2", "--out", "a.toml"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    expect_refused(arguments, option.front() + " does not go with --replay-move");
  }
}

TEST_F(CampaignProgram, RefusesWhatRunsOfLampsDoNotHave) {
  expect_refused({"--lamps"}, "expected a limit");
  expect_refused({"--lamps", "--merge", "a.csv"}, "--lamps does not go with --merge");
  expect_refused({"--sizes", "--merge", "a.csv"}, "--sizes does not go with --merge");
  expect_refused({"--lamps", "--moves", "1", "--resume", "a.csv"}, "--resume does not go with");
  expect_refused({"--lamps", "--moves", "1", "--without-margin-check"},
                 "--without-margin-check does not go with --lamps");
  expect_refused({"--lamps", "--replay-move", "1:3", "--out", "a.toml", "--reduce"},
                 "--reduce does not go with --lamps");
  expect_refused({"--lamps", "--moves", "1", "--report", "no/such/r.csv"}, "no/such/r.csv");
}

// Run 3 is of a frozen picture before a tool at rest.
TEST_F(CampaignProgram, RunsLampsAndTellsHowLongEachFaultHadNoName) {
  const ProgramRun lamps =
      run({"--lamps", "--moves", "1", "--first-move", "3", "--report", "r.csv"});
  EXPECT_EQ(lamps.status, 0) << lamps.err;
  EXPECT_EQ(lamps.err, "") << "nothing to look at";
  EXPECT_EQ(lamps.out.find("seed 1: runs 3 to 3 of lamps\n"), 0U) << lamps.out;
  EXPECT_NE(lamps.out.find("wrong tube vouched for: 0 fields"), std::string::npos) << lamps.out;
  EXPECT_NE(folder_.read("r.csv").find("\nfrozen/rests,1,"), std::string::npos);
  EXPECT_NE(folder_.read("r.csv").find("\nall,1,"), std::string::npos);

  const ProgramRun written = run({"--lamps", "--replay-move", "1:3", "--out", "lamp.toml"});
  EXPECT_EQ(written.status, 0) << written.err;
  EXPECT_NE(written.out.find("run 1:3, frozen/rests\n"), std::string::npos) << written.out;
  EXPECT_NE(written.out.find("  unseen after "), std::string::npos) << written.out;
  EXPECT_NE(written.out.find("lamp.toml: shows the same\n"), std::string::npos) << written.out;
  EXPECT_NE(folder_.read("lamp.toml").find("kind = \"frozen\""), std::string::npos);
}

TEST_F(CampaignProgram, DrawsOtherPictureSizesWhichAreProgressOfTheirOwn) {
  const ProgramRun sizes = run({"--sizes", "--moves", "1", "--resume", "sizes.csv"});
  EXPECT_EQ(sizes.status, 0) << sizes.err;
  EXPECT_NE(sizes.out.find("-sizes\n"), std::string::npos) << sizes.out;
  expect_refused({"--moves", "2", "--resume", "sizes.csv"}, "-sizes");
  const ProgramRun written = run({"--sizes", "--replay-move", "1:0", "--out", "size.toml"});
  EXPECT_EQ(written.status, 0) << written.err;
  EXPECT_NE(written.out.find("size.toml: shows the same\n"), std::string::npos) << written.out;
  EXPECT_EQ(folder_.read("size.toml").find("width_px = 635"), std::string::npos);
}

TEST_F(CampaignProgram, RefusesFilesThatAreNoProgressOfThisBox) {
  expect_refused({"--merge", "missing.csv"}, "missing.csv");
  folder_.write("other.csv", "field,frame\n0,0\n");
  expect_refused({"--merge", "other.csv"}, "other.csv");
  expect_refused({"--moves", "1", "--resume", "other.csv"}, "other.csv");
  expect_refused({"--moves", "1", "--resume", "no/such/folder.csv"}, "no/such/folder.csv");
  EXPECT_EQ(folder_.read("other.csv"), "field,frame\n0,0\n") << "left as it was";
}

TEST_F(CampaignProgram, WritesNothingOverAProgressFile) {
  folder_.write("p.csv", "a night's work\n");
  const std::string about = "is also ";
  expect_refused({"--moves", "1", "--resume", "p.csv", "--report", "p.csv"}, about + "--resume");
  expect_refused({"--moves", "1", "--resume", "p.csv", "--report", "./p.csv"}, about + "--resume");
  expect_refused({"--moves", "1", "--resume", "new.csv", "--report", "new.csv"},
                 about + "--resume");
  expect_refused({"--merge", "q.csv", "p.csv", "--report", "p.csv"}, about + "a file of --merge");
  expect_refused({"--merge", "q.csv", "p.csv", "--out", "p.csv"}, about + "a file of --merge");
  expect_refused({"--merge", "p.csv", "--out", "r.csv", "--report", "r.csv"}, about + "--out");
  EXPECT_EQ(folder_.read("p.csv"), "a night's work\n");
}

TEST_F(CampaignProgram, ResumesMergesAndReports) {
  ASSERT_EQ(run({"--moves", "1", "--resume", "a.csv"}).status, 0);
  const ProgramRun resumed = run({"--moves", "2", "--resume", "a.csv", "--report", "report.csv"});
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_NE(resumed.out.find("seed 1: moves 0 to 1\n"), std::string::npos) << resumed.out;
  EXPECT_NE(folder_.read("report.csv").find("\nall,2,"), std::string::npos);
  ASSERT_EQ(run({"--moves", "1", "--first-move", "2", "--resume", "b.csv"}).status, 0);
  const ProgramRun merged = run({"--merge", "a.csv", "b.csv", "--out", "all.csv"});
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_NE(merged.out.find("seed 1: moves 0 to 2\n"), std::string::npos) << merged.out;
  // The same as three moves at one go, but for the time they took.
  const ProgramRun at_once = run({"--moves", "3"});
  const auto after_time = [](const std::string& text) { return text.substr(text.find("\n\n")); };
  EXPECT_EQ(after_time(merged.out), after_time(at_once.out));

  expect_refused({"--merge", "a.csv", "all.csv"}, "expected each move once");
  std::string other = folder_.read("a.csv");
  for (std::size_t at = 0; (at = other.find(",0.", at)) != std::string::npos;) {
    other[at + 1] = '7';
  }
  folder_.write("other.csv", other);
  expect_refused({"--moves", "3", "--resume", "other.csv"}, "it is of box 7.");
}

// Move 0 would be another machine's, and the later merge would refuse the file.
TEST_F(CampaignProgram, ResumesBehindTheMovesOfItsFile) {
  ASSERT_EQ(run({"--moves", "1", "--seed", "4", "--first-move", "200", "--resume", "p.csv"}).status,
            0);
  const ProgramRun resumed = run({"--moves", "2", "--resume", "p.csv"});
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_EQ(resumed.out.find("seed 4: moves 200 to 201\n"), 0U) << resumed.out;
  const ProgramRun told =
      run({"--moves", "3", "--seed", "4", "--first-move", "0", "--resume", "p.csv"});
  EXPECT_EQ(told.out.find("seed 4: moves 0 to 0\nseed 4: moves 200 to 201\n"), 0U) << told.out;
}

TEST_F(CampaignProgram, EndsAtWhicheverLimitComesFirst) {
  const ProgramRun ended = run({"--moves", "1", "--fields", "1000000", "--hours", "1"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.out.find("seed 1: moves 0 to 0\n"), 0U) << ended.out;
}

TEST_F(CampaignProgram, FailsItsSelfProofWhenThatFindsNothing) {
  const ProgramRun blind = run({"--moves", "1", "--without-margin-check", "--resume", "blind.csv"});
  EXPECT_EQ(blind.status, 1);
  EXPECT_EQ(blind.err,
            "self-proof: no wrong tube found without the margin check, expected one at least\n");
  EXPECT_EQ(run({"--merge", "blind.csv"}).status, 1) << "the file says what it is of";
  const ProgramRun found = run({"--moves", "1", "--first-move", "43", "--without-margin-check"});
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_EQ(found.err.find("wrong tube vouched for: move 1:43"), 0U) << found.err;
}

TEST_F(CampaignProgram, WritesAMoveThatSimulateTakes) {
  const ProgramRun written = run({"--replay-move", "1:8", "--out", "move.toml"});
  EXPECT_EQ(written.status, 0) << written.err;
  EXPECT_NE(written.out.find("move 1:8, square/upright/flush/stream/slow"), std::string::npos);
  EXPECT_NE(written.out.find("move.toml: shows the same"), std::string::npos) << written.out;
  EXPECT_EQ(run_tubesight(folder_, {"simulate", "move.toml", "--out", "move"}).status, 0);
  EXPECT_EQ(run_tubesight(folder_, {"replay", "move.session.toml", "move.y4m", "--fields", "f.csv"})
                .status,
            0);
  expect_refused({"--replay-move", "1:8", "--out", "again.toml", "--reduce"}, "no wrong tube");
}

}  // namespace
}  // namespace tubesight::tests
