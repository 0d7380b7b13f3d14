// tubesightd and tubesightctl as a user starts them, on the shipped recording in real time.

#include "tests/system/daemon.h"

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/control/json_line.h"
#include "drivers/control/socket_address.h"

namespace tubesight::tests {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(DaemonSystem, TracksByItsScriptAndTellsHowItIsDoing) {
  Daemon box;
  box.write_settings("script = true\n");
  ASSERT_TRUE(box.start_and_wait()) << box.said();

  // Each pass begins under that tube; a status may be of any moment.
  const std::string status = box.wait_for("\"tube\":\"40,60\"", kLong);

  EXPECT_TRUE(has(status, "\"state\":\"tracking\"")) << status;
  EXPECT_TRUE(has(status, "\"protocol\":1,\"ok\":true")) << status;
  EXPECT_TRUE(has(status, "\"tube\":\"40,60\"")) << status;
  const Answered text = box.ask({"status"});
  EXPECT_TRUE(has(text.out, "tracking  ")) << text.out;
  box.signal(SIGTERM);
  EXPECT_EQ(box.wait_for_end(kLong), 0) << box.said();
  EXPECT_FALSE(std::filesystem::exists(box.socket()));
  EXPECT_TRUE(has(box.said(), "tubesightd: stopped\n")) << box.said();
}

TEST(DaemonSystem, WaitsForAStartAndAnswersWhoAsks) {
  Daemon box;
  box.write_settings("");
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  EXPECT_TRUE(has(box.wait_for("\"tracking\":", kLong), "\"state\":\"waiting\""));

  const Answered pick = box.ask({"pick", "313,196"});
  EXPECT_EQ(pick.status, 1);
  EXPECT_TRUE(has(pick.err, "did not know")) << pick.err;
  const Answered lamp = box.ask({"lamp", "500"});
  EXPECT_EQ(lamp.status, 1) << "a recording has no lamp";
  const Answered start = box.ask({"start", "40,60,1,1;41,60,2,2;40,61,3,3"});
  EXPECT_EQ(start.status, 1);
  EXPECT_TRUE(has(start.err, "refused: ")) << start.err;
  const Answered record = box.ask({"record"});
  EXPECT_EQ(record.status, 1);
  EXPECT_TRUE(has(record.err, "nothing is recorded")) << record.err;
  const Answered wrong = box.ask({"start", "nonsense"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_EQ(box.ask({"lamp", "5000"}).status, 2);
  EXPECT_EQ(box.ask({"dance"}).status, 2);
}

/// Asks for starts until one falls on the beginning of a pass, where the clicks belong.
bool start_by_hand(const Daemon& box) {
  for (int i = 0; i < 400; ++i) {
    if (box.ask({"start"}).status == 0) {
      return true;
    }
  }
  return false;
}

TEST(DaemonSystem, AKilledBoxLeavesASocketBehindAndItsSuccessorWaitsForAStart) {
  Daemon box;
  box.write_settings("");
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  ASSERT_TRUE(start_by_hand(box)) << box.said();
  box.signal(SIGKILL);
  ASSERT_EQ(box.wait_for_end(kLong), -1);
  ASSERT_TRUE(std::filesystem::exists(box.socket()));
  EXPECT_EQ(box.ask({"status"}).status, 3) << "nobody is there";

  ASSERT_TRUE(box.start_and_wait()) << box.said();

  EXPECT_TRUE(has(box.wait_for("\"tracking\":", kLong), "\"state\":\"waiting\""));
}

TEST(DaemonSystem, ABoxThatDiesOfAMistakeLeavesTheLampDarkAndSaysWhy) {
  Daemon box;
  box.write_simulated_settings("script = true\n");
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  ASSERT_TRUE(has(box.wait_for("\"state\":\"tracking\"", kLong), "\"tracking\""));

  box.signal(SIGSEGV);

  EXPECT_EQ(box.wait_for_end(kLong), -1) << "whoever watches sees a signal";
  EXPECT_TRUE(has(box.said(), "tubesightd: panic: SIGSEGV: the lamp is dark\n")) << box.said();
  EXPECT_TRUE(box.start_and_wait()) << box.said();
}

TEST(DaemonSystem, EndsWithTheTerminalThatItWasStartedIn) {
  Daemon box;
  box.write_settings("");
  ASSERT_TRUE(box.start_and_wait()) << box.said();

  box.signal(SIGHUP);

  EXPECT_EQ(box.wait_for_end(kLong), 0) << box.said();
  EXPECT_TRUE(has(box.said(), "tubesightd: stopped\n")) << "the lamp went dark: " << box.said();
}

TEST(DaemonSystem, SignalsThatNobodyMeantEndItAsOthersDo) {
  for (const int signal : {SIGUSR1, SIGUSR2, SIGALRM}) {
    Daemon box;
    box.write_settings("");
    ASSERT_TRUE(box.start_and_wait()) << box.said();
    box.signal(signal);
    EXPECT_EQ(box.wait_for_end(kLong), 0) << signal << ": " << box.said();
  }
}

TEST(DaemonSystem, GoesOnWithoutFieldsWhenTheRecordingHasEnded) {
  Daemon box;
  box.write_settings("at_end = \"end\"\nscript = true\n");
  ASSERT_TRUE(box.start_and_wait()) << box.said();

  const std::string status = box.wait_for("\"state\":\"lost\"", kLong);

  EXPECT_TRUE(has(status, "\"source\":{\"kind\":\"replay\",\"state\":\"ended\"")) << status;
  const std::int64_t missing = drivers::find_json_number(status, "missing", 0);
  EXPECT_GT(missing, 0);
  const std::string later = box.wait_for("\"missing\":" + std::to_string(missing), milliseconds(0));
  EXPECT_GE(drivers::find_json_number(later, "missing", 0), missing);
  const Answered test = box.ask({"self-test"});
  EXPECT_EQ(test.status, 1);
  EXPECT_TRUE(has(test.out, "source    bad")) << test.out;
  box.signal(SIGINT);
  EXPECT_EQ(box.wait_for_end(kLong), 0);
}

TEST(DaemonSystem, TheFirstRunOfTheDocumentsTracksASimulatedSheet) {
  Daemon box;
  box.write_simulated_settings("");
  ASSERT_TRUE(box.start_and_wait()) << box.said();

  const Answered start = box.ask({"start"});
  EXPECT_EQ(start.status, 0) << start.err;
  EXPECT_EQ(start.out, "taken: the box tracks\n");
  const std::string status = box.wait_for("\"state\":\"tracking\"", kLong);
  EXPECT_TRUE(has(status, "\"tube\":\"40,60\",\"aligned\":true")) << status;
  const Answered pick = box.ask({"pick", "318,190"});
  EXPECT_EQ(pick.out, "tube 40,60\n") << pick.err;
  const Answered lamp = box.ask({"lamp", "0"});
  EXPECT_EQ(lamp.status, 0) << lamp.err;
  const std::string dark = box.wait_for("\"reason\":\"dark\"", kLong);
  EXPECT_TRUE(has(dark, "\"reason\":\"dark\"")) << "the lamp of the sheet obeys: " << dark;
  EXPECT_TRUE(has(dark, "\"lamp\":{\"dimmed\":true,\"permille\":0,")) << dark;
}

TEST(DaemonSystem, AScenariosScriptStartsTheBox) {
  Daemon box;
  box.write_simulated_settings("script = true\n");
  ASSERT_TRUE(box.start_and_wait()) << box.said();

  EXPECT_TRUE(has(box.wait_for("\"state\":\"tracking\"", kLong), "\"state\":\"tracking\""));
}

TEST(DaemonSystem, ASecondBoxOnTheSameSocketIsRefused) {
  Daemon box;
  box.write_settings("");
  ASSERT_TRUE(box.start_and_wait()) << box.said();

  const Answered second = run_program(TUBESIGHT_DAEMON, {box.settings()});

  EXPECT_EQ(second.status, 1);
  EXPECT_TRUE(has(second.err, "another program listens there")) << second.err;
  EXPECT_EQ(box.ask({"status"}).status, 0);
}

TEST(DaemonSystem, GarbageAndDeafClientsDoNotDisturb) {
  Daemon box;
  box.write_settings("script = true\n");
  ASSERT_TRUE(box.start_and_wait()) << box.said();
  std::array<int, 24> clients{};
  const std::string garbage(3000, '\xfe');
  for (int& client : clients) {
    client = drivers::connect_to(box.socket());
    static_cast<void>(send(client, garbage.data(), garbage.size(), MSG_NOSIGNAL));
    const std::string many = "1 status\n1 status\n1 status\n";
    static_cast<void>(send(client, many.data(), many.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  }

  EXPECT_EQ(box.ask({"status"}).status, 0) << box.said();
  EXPECT_TRUE(has(box.wait_for("\"state\":\"tracking\"", kLong), "\"state\":\"tracking\""));
  for (const int client : clients) {
    close(client);
  }
}

TEST(DaemonSystem, CheckTellsEveryMistakeAndOpensNothing) {
  Daemon box;
  box.write_settings("");
  const Answered good = run_program(TUBESIGHT_DAEMON, {box.settings(), "--check"});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_EQ(good.err, "");
  EXPECT_FALSE(std::filesystem::exists(box.socket()));

  box.write_settings("speed = 2\nat_end = \"never\"\n[link]\nkind = \"carrier pigeon\"\n");
  const Answered wrong = run_program(TUBESIGHT_DAEMON, {box.settings(), "--check"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(has(wrong.err, "box.toml:7: source.speed: unknown key")) << wrong.err;
  EXPECT_TRUE(has(wrong.err, "box.toml:8: source.at_end: ")) << wrong.err;
  EXPECT_TRUE(has(wrong.err, "box.toml:10: link.kind: ")) << wrong.err;
  EXPECT_EQ(run_program(TUBESIGHT_DAEMON, {box.settings()}).status, 2);
  EXPECT_EQ(run_program(TUBESIGHT_DAEMON, {}).status, 2);
  EXPECT_EQ(run_program(TUBESIGHT_DAEMON, {box.folder().path("none.toml")}).status, 2);
}

TEST(ControlProgram, SaysWhenNoBoxIsThere) {
  const support::TemporaryFolder folder;

  const Answered run = run_program(TUBESIGHT_CTL, {"--socket", folder.path("box"), "status"});

  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.err, "tubesightctl: " + folder.path("box") + ": no box listens there\n");
}

}  // namespace
}  // namespace tubesight::tests
