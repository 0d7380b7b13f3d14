// tubesightd on a simulated sheet in real time, and a robot program that is not ours at its link:
// docs/examples/robot.py, which stands on pymodbus, as the first run of the documents starts it.

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/control/json_line.h"
#include "drivers/scenario/scenario_file.h"
#include "drivers/simulated/simulated_world.h"
#include "tests/drivers/modbus/serial_robot.h"
#include "tests/system/daemon.h"
#include "tests/system/tcp_line.h"

namespace tubesight::tests {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr const char* kExamples = TUBESIGHT_SOURCE_DIR "/docs/examples/";

constexpr const char* kLineSettings = ",115200,N";

/// What the robot program does in so many seconds, asking 20 times each.
Answered run_robot(const std::string& line, const std::string& for_s) {
  return run_program("/usr/bin/python3", {"-B", std::string(kExamples) + "robot.py", line, for_s});
}

/// One claim as the program prints it, "40,60 AGREE tube 40,60 field 671".
struct Claimed {
  core::TubeAddress claim{};
  std::string verdict;
  bool named = false;
  core::TubeAddress tube{};
  std::int64_t field = -1;
};

bool parse(const std::string& line, Claimed& out) {
  std::istringstream words(line);
  std::string claim;
  std::string verdict;
  std::string word;
  words >> claim;
  while (words >> word && word != "tube") {
    verdict += verdict.empty() ? word : " " + word;
  }
  std::string tube;
  std::string field;
  words >> tube >> field >> out.field;
  out.verdict = verdict;
  out.named = std::sscanf(tube.c_str(), "%d,%d", &out.tube.row, &out.tube.column) == 2;
  return word == "tube" && field == "field" &&
         std::sscanf(claim.c_str(), "%d,%d", &out.claim.row, &out.claim.column) == 2;
}

/// What the verdicts come to, judged by the truth of the scenario at the very field of each.
struct Tally {
  int agree = 0;
  int disagree = 0;
  int cannot_say = 0;
  int wrong = 0;
  int unanswered = 0;
  std::string first_wrong;
};

class RobotLinkSystem : public ::testing::Test {
 protected:
  RobotLinkSystem() {
    drivers::Messages messages;
    EXPECT_TRUE(drivers::load_scenario(std::string(kExamples) + "steam-generator.toml", {-1, true},
                                       *scenario_, messages));
    EXPECT_TRUE(world_->configure(scenario_->scenario));
  }

  /// A pseudo terminal knows no parity.
  static std::string serial_link(const std::string& device) {
    return "[link]\nkind = \"modbus\"\nbaud = 115200\nparity = \"none\"\ndevice = \"" + device +
           "\"\n";
  }

  [[nodiscard]] core::TubeAddress true_tube(std::int64_t field) {
    const core::rendering::NearestTube near = world_->truth_of(field).axis.nearest;
    return near.address;
  }

  /// Within the rest at the scenario's beginning, whatever fields did not come. The moves have a
  /// test of their own, mission_test.cpp.
  Tally judge(const std::string& out) {
    Tally tally;
    std::istringstream lines(out);
    std::string line;
    Claimed each;
    while (std::getline(lines, line)) {
      if (!parse(line, each)) {
        continue;
      }
      if (each.verdict == "CANNOT SAY") {
        ++tally.cannot_say;
        continue;
      }
      if (each.verdict != "AGREE" && each.verdict != "DISAGREE") {
        ++tally.unanswered;
        continue;
      }
      const core::TubeAddress truth = true_tube(each.field);
      const bool agree = each.verdict == "AGREE";
      ++(agree ? tally.agree : tally.disagree);
      if (agree != (each.claim == truth) || !each.named || !(each.tube == truth)) {
        tally.first_wrong = ++tally.wrong == 1 ? line : tally.first_wrong;
      }
    }
    return tally;
  }

  std::unique_ptr<drivers::ScenarioFile> scenario_ = std::make_unique<drivers::ScenarioFile>();
  std::unique_ptr<drivers::SimulatedWorld> world_ = std::make_unique<drivers::SimulatedWorld>();
};

TEST_F(RobotLinkSystem, TheRobotProgramOfTheDocumentsStartsTheBoxAndIsToldTheTruth) {
  Daemon box;
  const int port = free_port();
  box.write_simulated_settings(tcp_link(port));
  ASSERT_TRUE(box.start_and_wait()) << box.said();

  const Answered run = run_robot(address(port), "3");

  const std::string status = box.ask({"status", "--json"}).out;
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.out, "start taken\n")) << run.out;
  EXPECT_TRUE(has(status, "\"link\":{\"kind\":\"modbus\",\"open\":true")) << status;
  EXPECT_GT(drivers::find_json_number(status, "requests", 0), 120);
  const Tally tally = judge(run.out);
  EXPECT_EQ(tally.wrong, 0) << tally.first_wrong;
  EXPECT_EQ(tally.unanswered, 0) << run.out;
  EXPECT_EQ(tally.agree + tally.disagree + tally.cannot_say, 60);
  EXPECT_GT(tally.agree, 20) << run.out;
  EXPECT_GT(tally.disagree, 20) << run.out;
}

TEST_F(RobotLinkSystem, AnswersOverASerialLineToo) {
  const PtyPair line;
  Daemon box;
  box.write_simulated_settings(serial_link(line.box.device()));
  ASSERT_TRUE(box.start_and_wait()) << box.said();

  const Answered run = run_robot(line.robot.device() + kLineSettings, "4");

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.out, "start taken\n")) << run.out;
  const Tally tally = judge(run.out);
  EXPECT_EQ(tally.wrong, 0) << tally.first_wrong;
  EXPECT_EQ(tally.unanswered, 0) << run.out;
  EXPECT_GT(tally.agree, 20) << run.out;
  EXPECT_GT(tally.disagree, 20) << run.out;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Registers, by mbpoll.
std::string polled(int port, const std::string& address, const std::string& count = "1") {
  return run_program("/usr/bin/mbpoll", {"-m", "tcp", "-p", std::to_string(port), "-0", "-1", "-q",
                                         "-t", "4", "-r", address, "-c", count, "127.0.0.1"})
      .out;
}

/// The register `aligned`.
std::string polled_alignment(int port) { return polled(port, "145"); }

TEST_F(RobotLinkSystem, AKilledBoxComesBackWithAnotherBootNumberAndVouchesForNothing) {
  Daemon box;
  const int port = free_port();
  box.write_simulated_settings(tcp_link(port));
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  const Answered before = run_robot(address(port), "1");
  ASSERT_TRUE(has(before.out, " AGREE tube 40,60 ")) << before.out << before.err;
  EXPECT_TRUE(has(polled_alignment(port), "[145]: \t1")) << polled_alignment(port);
  EXPECT_TRUE(has(polled(port, "501"), "[501]: \t1")) << "camera_health: well";
  EXPECT_TRUE(has(polled(port, "1"), "[1]: \t3")) << "camera_id and tool_id are known";
  const std::string camera_and_tool = polled(port, "10", "4");
  box.signal(SIGKILL);
  ASSERT_EQ(box.wait_for_end(kLong), -1);

  ASSERT_TRUE(box.start_and_wait()) << box.said();

  ASSERT_TRUE(
      has(box.wait_for("\"link\":{\"kind\":\"modbus\",\"open\":true", kLong), "\"open\":true"))
      << box.said();
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(has(polled_alignment(port), "[145]: \t0"));
    std::this_thread::sleep_for(milliseconds(50));
  }
  EXPECT_EQ(polled(port, "10", "4"), camera_and_tool) << "the same settings";
  const Answered after = run_robot(address(port), "1");
  EXPECT_TRUE(has(first_line(after.out), ", tube -, not vouched for")) << after.out;
  EXPECT_NE(first_line(after.out), first_line(before.out)) << "the boot number is another";
  EXPECT_TRUE(has(after.out, "start taken\n")) << after.out;
  EXPECT_TRUE(has(after.out, " AGREE tube 40,60 ")) << after.out;
}

TEST_F(RobotLinkSystem, TheRobotReadsThatTheSourceHasEnded) {
  Daemon box;
  const int port = free_port();
  box.write_settings("at_end = \"end\"\nscript = true\n" + tcp_link(port));
  ASSERT_TRUE(box.start_and_wait()) << box.said();

  ASSERT_TRUE(has(box.wait_for("\"state\":\"ended\"", kLong), "\"ended\"")) << box.said();

  // judged_fields stands still, and no tube is named or vouched for.
  std::this_thread::sleep_for(milliseconds(150));
  const std::string judged = polled(port, "109");
  EXPECT_FALSE(has(judged, "[109]: \t0\n")) << "it had tracked";
  const std::string valid = polled(port, "104");
  const std::size_t at = valid.find("[104]: \t");
  ASSERT_NE(at, std::string::npos) << valid;
  constexpr int kPlaces = 0b11111000;  // primary tube, tube, axis, margin, velocity
  EXPECT_EQ(std::stoi(valid.substr(at + 8)) & kPlaces, 0) << valid;
  EXPECT_TRUE(has(polled_alignment(port), "[145]: \t0"));
  EXPECT_EQ(polled(port, "109"), judged);
  // camera_health: failed; lamp_mode_now: nobody dims it.
  EXPECT_TRUE(has(polled(port, "501"), "[501]: \t2")) << polled(port, "501");
  EXPECT_TRUE(has(polled(port, "505"), "[505]: \t0")) << polled(port, "505");
}

TEST_F(RobotLinkSystem, ABoxWhoseLineIsMissingServesItsOperatorAndTakesTheLineWhenItComes) {
  Daemon box;
  const std::string device = box.folder().path("line");
  box.write_simulated_settings(serial_link(device));
  const Answered check = run_program(TUBESIGHT_DAEMON, {box.settings(), "--check"});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_EQ(check.err, "") << "no device is looked for";
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  EXPECT_TRUE(has(box.said(), "link: cannot be opened: " + device + ": No such file"))
      << box.said();
  EXPECT_EQ(box.ask({"start"}).status, 0) << "an operator can use it";
  EXPECT_TRUE(has(box.ask({"self-test"}).out, "link      bad    modbus, not open"));

  const PtyPair line;
  std::filesystem::create_symlink(line.box.device(), device);

  EXPECT_TRUE(has(box.wait_for("\"open\":true", kLong), "\"open\":true")) << box.said();
  const Answered run = run_robot(line.robot.device() + kLineSettings, "0");
  EXPECT_TRUE(has(run.out, ", tube 40,60, vouched for\n")) << run.out << run.err;
}

}  // namespace
}  // namespace tubesight::tests
