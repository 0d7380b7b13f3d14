// `tubesight pose` on frames of recordings in which the tool goes from tube to tube: clicks belong
// to one frame, and a wrong tube must not be named in any other.

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/system/csv_rows.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using support::TemporaryFolder;

const std::string kLibrary = std::string(TUBESIGHT_TEST_DATA_DIR) + "/scenarios/";

/// A scenario of the library as a recording with its truth.
class PoseFrames : public ::testing::Test {
 protected:
  void simulate(const std::string& scenario) {
    const ProgramRun run = run_tubesight(folder_, {"simulate", kLibrary + scenario, "--out", "r"});
    ASSERT_EQ(run.status, 0) << run.err;
    for (const Row& row : read_rows(folder_.read("r.truth.csv"))) {
      truth_[std::stoi(row.at("frame"))] = {row.at("near_row"), row.at("near_col")};
    }
  }

  [[nodiscard]] ProgramRun pose(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"pose", "r.session.toml", "r.y4m"});
    return run_tubesight(folder_, arguments);
  }

  /// The frames that a table names a tube for, each of which must be the true one.
  [[nodiscard]] std::map<int, Row> named(const std::string& csv) const {
    std::map<int, Row> frames;
    for (const Row& row : read_rows(folder_.read(csv))) {
      const int frame = std::stoi(row.at("image").substr(row.at("image").rfind(' ')));
      if (!row.at("row").empty()) {
        EXPECT_EQ(std::pair(row.at("row"), row.at("column")), truth_.at(frame)) << frame;
        frames[frame] = row;
      }
    }
    return frames;
  }

  [[nodiscard]] std::string last_frame() const { return std::to_string(truth_.rbegin()->first); }

  /// Places of three tubes in a frame of which the truth tells tube-ends.
  [[nodiscard]] std::string start_in(int frame) const {
    const int row = std::stoi(truth_.at(frame).first);
    const int column = std::stoi(truth_.at(frame).second);
    std::string start;
    for (const Row& tube : read_rows(folder_.read("r.centers.csv"))) {
      const int r = std::stoi(tube.at("row"));
      const int c = std::stoi(tube.at("col"));
      if (std::stoi(tube.at("frame")) == frame && tube.at("field") == "0" &&
          ((r == row && (c == column || c == column + 1)) || (r == row + 1 && c == column))) {
        start += tube.at("row") + "," + tube.at("col") + "," + tube.at("x_f") + "," +
                 tube.at("y_f") + ";";
      }
    }
    return start;
  }

  TemporaryFolder folder_;
  std::map<int, std::pair<std::string, std::string>> truth_;
};

void expect_one_line(const ProgramRun& run, int status, const std::string& part) {
  EXPECT_EQ(run.status, status);
  EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << run.err;
  EXPECT_EQ(run.out, "");
}

TEST_F(PoseFrames, OfAToolThatMovesFromTubeToTubeNameTheTrueTubeOrNone) {
  simulate("moves-square.toml");

  const ProgramRun run = pose({"--frames", "0-" + last_frame(), "--csv", "p.csv"});

  // Refused while the tool moves between the two fields of a frame.
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("between the two fields of a frame"), std::string::npos);
  const std::map<int, Row> frames = named("p.csv");
  EXPECT_GT(frames.size(), 30U);
  EXPECT_EQ(frames.at(0).at("column"), "60");
  EXPECT_EQ(frames.at(81).at("row") + " " + frames.at(81).at("column"), "42 62");
  // One frame alone says the same.
  const ProgramRun one = pose({"--frames", "81", "--csv", "one.csv"});
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(named("one.csv").at(81), frames.at(81));
  // And several averaged.
  const ProgramRun mean = pose({"--frames", "76-81", "--average", "--csv", "mean.csv"});
  EXPECT_EQ(mean.status, 0) << mean.err;
  EXPECT_EQ(named("mean.csv").size(), 1U);
}

TEST_F(PoseFrames, OfAProgressiveCameraInMotionNameTheTrueTubeOrNone) {
  simulate("camera-progressive.toml");

  static_cast<void>(pose({"--frames", "0-" + last_frame(), "--csv", "p.csv"}));

  EXPECT_GT(named("p.csv").size(), 30U);
}

TEST_F(PoseFrames, WithAStartOfTheirOwnBeginInTheFirstOfThem) {
  simulate("moves-square.toml");

  static_cast<void>(pose({"--frames", "40-81", "--start", start_in(40), "--csv", "p.csv"}));

  const std::map<int, Row> frames = named("p.csv");
  EXPECT_EQ(frames.at(40).at("column"), "63");
  EXPECT_EQ(frames.at(81).at("row") + " " + frames.at(81).at("column"), "42 62");
}

TEST_F(PoseFrames, BehindTheLossOfTheTubesAreRefusedUntilALaterStart) {
  simulate("restart.toml");

  const ProgramRun dark = pose({"--frames", "50", "--csv", "dark.csv"});
  const ProgramRun all = pose({"--frames", "0-" + last_frame(), "--csv", "p.csv"});
  const ProgramRun users =
      pose({"--frames", "0-" + last_frame(), "--start", start_in(0), "--csv", "u.csv"});

  expect_one_line(dark, 1,
                  "r.y4m frame 50: no pose: which tubes this frame shows is not known: "
                  "the tracking lost them in field ");
  EXPECT_NE(dark.err.find(" (coasted: "), std::string::npos) << dark.err;
  // The operator's second start, at 2.0 s, is in the event file.
  EXPECT_EQ(all.status, 1);
  EXPECT_TRUE(named("p.csv").contains(65));
  EXPECT_FALSE(named("p.csv").contains(55));
  // It does not count beside places named on the command line.
  EXPECT_EQ(users.status, 1);
  EXPECT_FALSE(named("u.csv").contains(65));
  EXPECT_TRUE(named("u.csv").contains(5));
}

TEST_F(PoseFrames, BehindARefusedStartAreRefused) {
  simulate("rest-square.toml");
  const std::string beside = "40,60,60,60;41,60,60,160;40,61,160,60";

  const ProgramRun run = pose({"--frames", "3-4", "--start", beside});

  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("frame 4: no pose: which tubes this frame shows is not known: the start "
                         "was refused in field 6 ("),
            std::string::npos)
      << run.err;
}

TEST_F(PoseFrames, OfOnlyTheTubesNamedNeedThemInView) {
  simulate("moves-square.toml");

  const ProgramRun rest = pose({"--frames", "5", "--only-start", "--csv", "p.csv"});
  const ProgramRun gone = pose({"--frames", "81", "--only-start"});

  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_EQ(named("p.csv").at(5).at("tubes"), "3");
  expect_one_line(gone, 1,
                  " of the start is not seen in the search window, expected all of them "
                  "there with --only-start");
}

TEST_F(PoseFrames, AveragedMustFollowEachOther) {
  simulate("rest-square.toml");
  const std::string meta = folder_.read("r.meta.csv");
  std::string late;
  for (const Row& row : read_rows(meta)) {
    const int field = std::stoi(row.at("field"));
    late += row.at("field") + "," + std::to_string(field + (field >= 6 ? 120 : 0)) + "," +
            std::to_string(number(row, "time_s") + (field >= 6 ? 2.0 : 0.0)) + ",good,1000\n";
  }

  const ProgramRun sound = pose({"--frames", "0-5", "--average"});
  folder_.write("r.meta.csv", meta.substr(0, meta.find('\n') + 1) + late);
  const ProgramRun gap = pose({"--frames", "0-5", "--average"});
  const ProgramRun before = pose({"--frames", "0-2", "--average"});

  EXPECT_EQ(sound.status, 0) << sound.err;
  EXPECT_EQ(before.status, 0) << before.err;
  EXPECT_EQ(before.out.substr(0, before.out.find('\n')).find("r.y4m frame 0: average of 3"), 0U);
  expect_one_line(gap, 1,
                  "r.y4m: no pose: field 6 comes so long after the field before it that "
                  "the tool can have moved on, expected frames one after the other for "
                  "--average");
}

TEST_F(PoseFrames, OfWhichAFieldIsDamagedAreRefused) {
  simulate("rest-square.toml");
  std::string meta = folder_.read("r.meta.csv");
  meta.replace(meta.find("good"), 4, "damaged");
  folder_.write("r.meta.csv", meta);

  expect_one_line(pose({}), 1, "r.y4m: no pose: field 0 is damaged or missing");
}

TEST_F(PoseFrames, WithoutAToolAreThoseOfTheStartAlone) {
  simulate("rest-square.toml");
  std::string session = folder_.read("r.session.toml");
  const std::size_t tool = session.find("[tool]");
  session.erase(tool, session.find("\n[", tool) + 1 - tool);
  folder_.write("r.session.toml", session);

  const ProgramRun first = pose({"--frames", "0-5", "--average"});
  const ProgramRun later = pose({"--frames", "5"});

  EXPECT_EQ(first.status, 0) << first.err;
  expect_one_line(later, 2,
                  "r.session.toml: tool: the table is missing, expected it for r.y4m "
                  "frame 5, as its tubes must be tracked from frame 0");
}

}  // namespace
}  // namespace tubesight::tests
