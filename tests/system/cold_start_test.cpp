// Starts of one click or two, or of none: the lattice found cold tells the rest, or the start is
// refused.

#include <cmath>
#include <cstddef>
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

using support::TemporaryFolder;

const std::string kStill = std::string(TUBESIGHT_TEST_DATA_DIR) + "/stills/square_flush/";
const std::string kRecording = std::string(TUBESIGHT_TEST_DATA_DIR) + "/recordings/square_flush/";
const std::string kOne = "{ row = 7, column = 41, at_px = [304, 240] }";
const std::string kOneOfRecording = "{ row = 40, column = 60, at_px = [313, 196] }";

std::string text_in(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A session's text with other clicks and further keys in [start].
std::string with_clicks(std::string text, const std::string& clicks, const std::string& keys = "") {
  const std::size_t from = text.find("tubes = [");
  const std::size_t to = text.find("window_px");
  return text.replace(from, to - from, clicks.empty() ? keys : "tubes = [" + clicks + "]\n" + keys);
}

class ColdStart : public ::testing::Test {
 protected:
  ProgramRun pose_with(const std::string& clicks, const std::string& keys,
                       std::vector<std::string> further = {}) {
    folder_.write("s.toml", with_clicks(text_in(kStill + "session.toml"), clicks, keys));
    std::vector<std::string> all = {"pose", "s.toml", kStill + "still-0-0.png", "--csv", "p.csv"};
    all.insert(all.end(), further.begin(), further.end());
    return run_tubesight(folder_, all);
  }

  ProgramRun replay_with(const std::string& clicks, const std::string& keys) {
    folder_.write("s.toml", with_clicks(text_in(kRecording + "session.toml"), clicks, keys));
    return run_tubesight(
        folder_, {"replay", "s.toml", kRecording + "recording.y4m.xz", "--fields", "f.csv"});
  }

  [[nodiscard]] Row answer() const { return read_rows(folder_.read("p.csv")).at(0); }

  void expect_under(const std::string& row, const std::string& column) {
    EXPECT_EQ(answer().at("row"), row);
    EXPECT_EQ(answer().at("column"), column);
  }

  static void expect_refused(const ProgramRun& run, const std::string& part) {
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << run.err;
    EXPECT_EQ(run.out, "");
  }

  TemporaryFolder folder_;
};

TEST_F(ColdStart, OfOneClickAndTheHeadingIsAsGoodAsOneOfThree) {
  ASSERT_EQ(pose_with(kOne, "heading_deg = 62\n").status, 0);

  expect_under("7", "41");
  EXPECT_NEAR(number(answer(), "tool_x_mm"), 1041.6, 0.01);
}

TEST_F(ColdStart, OfOneAddressAloneLeavesFourDirections) {
  expect_refused(
      pose_with(kOne, ""),
      "no pose: the addresses given leave 4 directions (the tool's heading -135.0, -45.0, "
      "45.0 or 135.0 degrees); expected heading_deg in [start], good to 20 degrees, or a "
      "second address");
}

TEST_F(ColdStart, OfAHeadingBetweenTheDirectionsIsRefused) {
  expect_refused(pose_with(kOne, "heading_deg = 70\n"),
                 "heading_deg: 70.0 is more than 20 degrees off each direction that is left");
}

TEST_F(ColdStart, OfAHeadingAQuarterTurnOffNamesTheTubesOfThatHeading) {
  // Nothing on a bare sheet tells: docs/pose.md says so.
  ASSERT_EQ(pose_with(kOne, "heading_deg = 135\n").status, 0);

  EXPECT_NEAR(number(answer(), "tool_alpha_deg"), 135.0, 0.1);
}

TEST_F(ColdStart, OfASecondAddressNeedsNoHeading) {
  ASSERT_EQ(pose_with(kOne + ", { row = 7, column = 42, at_px = [373, 192] }", "").status, 0);

  expect_under("7", "41");
}

TEST_F(ColdStart, OfTwoAddressesThatTheLatticeDoesNotJoinIsRefused) {
  expect_refused(pose_with(kOne + ", { row = 8, column = 42, at_px = [373, 192] }", ""),
                 "the addresses contradict the lattice: from tube (7, 41) at (304, 240)");
}

TEST_F(ColdStart, OfAClickOnTheSheetSaysThatNoTubeIsThere) {
  expect_refused(pose_with("{ row = 7, column = 41, at_px = [331, 270] }", "heading_deg = 45\n"),
                 "tube (7, 41) at (331, 270): no tube there, expected a place in the dark");
}

TEST_F(ColdStart, IsDecidedByTheSheetsEdgeWhereAllOtherDirectionsWouldBeBeyondIt) {
  std::string text = with_clicks(text_in(kStill + "session.toml"), kOne);
  const std::string all = "[-200, 400]";
  text.replace(text.find(all), all.size(), "[3, 400]");
  text.replace(text.find(all), all.size(), "[-200, 44]");
  folder_.write("s.toml", text);

  const ProgramRun run =
      run_tubesight(folder_, {"pose", "s.toml", kStill + "still-0-0.png", "--csv", "p.csv"});

  ASSERT_EQ(run.status, 0) << run.err;
  expect_under("7", "41");
  EXPECT_NEAR(number(answer(), "tool_alpha_deg"), 45.0, 0.1);
}

TEST_F(ColdStart, ThatTheMapRefutesIsRefusedWhateverTheHeading) {
  std::string text = with_clicks(text_in(kStill + "session.toml"), kOne, "heading_deg = 45\n");
  const std::string all = "[-200, 400]";
  text.replace(text.find(all), all.size(), "[7, 400]");
  folder_.write("s.toml", text);

  const ProgramRun run = run_tubesight(folder_, {"pose", "s.toml", kStill + "still-0-0.png"});

  expect_refused(run, "no pose: the map refutes it: ");
}

TEST_F(ColdStart, WithoutAnyAddressAnswersFromTheMiddleTube) {
  const ProgramRun run = pose_with("", "");

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("no address was given: the sheet's frame begins at the tube-end at"),
            std::string::npos)
      << run.out;
  expect_under("", "");
  EXPECT_NEAR(number(answer(), "tool_z_mm"), -40.0, 0.05);
  EXPECT_LT(std::abs(number(answer(), "tool_alpha_deg")), 46.0);
}

TEST_F(ColdStart, OptionsThatNeedAddressesSaySo) {
  const ProgramRun correct = pose_with("", "", {"--correct", "7,41"});
  EXPECT_EQ(correct.status, 2);
  EXPECT_EQ(correct.err,
            "--correct: no tube-end is named, expected an address in [start] or --start\n");

  const ProgramRun only = pose_with(kOne, "heading_deg = 45\n", {"--only-start"});
  EXPECT_EQ(only.status, 2);
  EXPECT_EQ(only.err, "--only-start: 1 tube-ends are named, expected three at least\n");
}

TEST_F(ColdStart, OfOneClickReplaysAsOneOfThree) {
  const ProgramRun run = replay_with(kOneOfRecording, "heading_deg = -15\n");

  ASSERT_EQ(run.status, 0) << run.err;
  const std::string fields = folder_.read("f.csv");
  EXPECT_EQ(run.err, "");
  EXPECT_NE(fields.find("0,0,even,0.000000,tracking,"), std::string::npos) << fields.substr(0, 400);
}

TEST_F(ColdStart, ThatIsRefusedLeavesAReplayWaiting) {
  const ProgramRun run = replay_with(kOneOfRecording, "");

  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("s.toml: start: the addresses given leave 4 directions"),
            std::string::npos)
      << run.err;
  EXPECT_NE(folder_.read("f.csv").find(",waiting,"), std::string::npos);
  EXPECT_NE(folder_.read("f.csv").find(",start-refused,"), std::string::npos);
  EXPECT_EQ(folder_.read("f.csv").find(",tracking,"), std::string::npos);
}

TEST_F(ColdStart, WithoutClicksLeavesAReplayWaitingForOne) {
  const ProgramRun run = replay_with("", "");

  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_NE(folder_.read("f.csv").find(",no-start,"), std::string::npos);
  EXPECT_EQ(folder_.read("f.csv").find(",tracking,"), std::string::npos);
}

}  // namespace
}  // namespace tubesight::tests
