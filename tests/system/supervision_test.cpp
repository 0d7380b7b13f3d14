// tubesightd under a service manager and beside a hardware watchdog: the test is the manager.

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>

#include "tests/support/environment_variable.h"
#include "tests/support/notify_socket.h"
#include "tests/system/daemon.h"

namespace tubesight::tests {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A thread of another process, found by its name, which does nothing as long as this lives.
class FrozenThread {
 public:
  FrozenThread(pid_t process, const std::string& name) {
    const std::string tasks = "/proc/" + std::to_string(process) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks)) {
      std::string said;
      std::getline(std::ifstream(task.path() / "comm") >> std::ws, said);
      if (said == name) {
        thread_ = static_cast<pid_t>(std::stol(task.path().filename().string()));
      }
    }
    int status = 0;
    frozen_ = thread_ > 0 && ptrace(PTRACE_SEIZE, thread_, 0, 0) == 0 &&
              ptrace(PTRACE_INTERRUPT, thread_, 0, 0) == 0 &&
              waitpid(thread_, &status, __WALL) == thread_;
  }
  FrozenThread(const FrozenThread&) = delete;
  FrozenThread& operator=(const FrozenThread&) = delete;
  ~FrozenThread() { thaw(); }

  [[nodiscard]] bool frozen() const { return frozen_; }
  void thaw() {
    if (frozen_) {
      ptrace(PTRACE_DETACH, thread_, 0, 0);
      frozen_ = false;
    }
  }
  /// Waits for the end of a thread whose process was killed: who traces it is told first.
  void outlive() {
    int status = 0;
    while (frozen_ && waitpid(thread_, &status, __WALL) == thread_) {
      frozen_ = !WIFEXITED(status) && !WIFSIGNALED(status);
    }
    frozen_ = false;
  }

 private:
  pid_t thread_ = -1;
  bool frozen_ = false;
};

/// A box that plays the shipped recording by its script, with this test as its service manager.
class Supervision : public testing::Test {
 protected:
  /// Whether the manager goes without a meal for so long.
  [[nodiscard]] bool starves(milliseconds time) const {
    // What was sent before is no meal of that time.
    while (!manager_.next(milliseconds(0)).empty()) {
    }
    return !manager_.hears("WATCHDOG=1", time);
  }

  Daemon box_;
  support::NotifySocket manager_{box_.folder().path("notify")};
  support::EnvironmentVariable socket_{"NOTIFY_SOCKET", manager_.name()};
  support::EnvironmentVariable watchdog_{"WATCHDOG_USEC", "2000000"};
};

TEST_F(Supervision, SaysWhenItIsReadyFeedsAndSaysWhenItStops) {
  box_.write_settings("");
  box_.start();

  ASSERT_TRUE(manager_.hears("READY=1", kLong)) << box_.said();
  EXPECT_TRUE(manager_.hears("STATUS=tracking: waiting", kLong)) << box_.said();
  EXPECT_TRUE(manager_.hears("WATCHDOG=1", seconds(3)));
  EXPECT_TRUE(manager_.hears("WATCHDOG=1", seconds(3))) << "twice within the two seconds allowed";
  EXPECT_EQ(box_.ask({"status"}).status, 0);
  const std::string status = box_.ask({"status", "--json"}).out;
  EXPECT_TRUE(has(status, R"("manager":{"there":true,"feed_within_ms":2000,"lost":0})")) << status;
  box_.signal(SIGTERM);
  EXPECT_TRUE(manager_.hears("STOPPING=1", kLong));
  EXPECT_EQ(box_.wait_for_end(kLong), 0) << box_.said();
}

TEST_F(Supervision, AStuckTrackingStarvesTheManagerAndItsKillLeavesABoxThatWaits) {
  box_.write_settings("");
  ASSERT_TRUE(box_.start_and_wait()) << box_.said();
  FrozenThread tracking(box_.process(), "tracking");
  ASSERT_TRUE(tracking.frozen()) << "no thread of that name, or tracing is not allowed";

  EXPECT_TRUE(has(box_.wait_for("\"stuck\":\"the tracking\"", kLong), "\"stuck\":\"the tracking\""))
      << "who asks is still answered: " << box_.said();
  EXPECT_TRUE(starves(milliseconds(1500)));
  box_.signal(SIGABRT);  // what systemd sends when WatchdogSec is over
  tracking.outlive();
  EXPECT_EQ(box_.wait_for_end(kLong), -1);
  EXPECT_TRUE(has(box_.said(), "panic: SIGABRT: the lamp is dark")) << box_.said();

  ASSERT_TRUE(box_.start_and_wait()) << box_.said();
  EXPECT_TRUE(has(box_.wait_for("\"tracking\":", kLong), "\"state\":\"waiting\""));
}

TEST_F(Supervision, WhatComesBackByItselfIsFedAgain) {
  box_.write_settings("");
  ASSERT_TRUE(box_.start_and_wait()) << box_.said();
  FrozenThread tracking(box_.process(), "tracking");
  ASSERT_TRUE(tracking.frozen());
  ASSERT_TRUE(has(box_.wait_for("\"stuck\":\"the tracking\"", kLong), "\"the tracking\""));

  tracking.thaw();

  EXPECT_TRUE(has(box_.wait_for("\"stuck\":\"\"", kLong), "\"stuck\":\"\"")) << box_.said();
  EXPECT_FALSE(starves(seconds(2)));
  EXPECT_TRUE(
      has(box_.said(), "supervision: stands still: the tracking; the watchdogs are not fed"))
      << box_.said();
}

TEST_F(Supervision, AStuckLinkStarvesTheManager) {
  box_.write_settings("[link]\nkind = \"modbus\"\ntcp_port = 15999\n");
  ASSERT_TRUE(box_.start_and_wait()) << box_.said();
  ASSERT_TRUE(has(box_.wait_for("\"open\":true", kLong), "\"open\":true")) << box_.said();
  EXPECT_FALSE(starves(seconds(2))) << "a link that no robot uses comes round, too";
  const FrozenThread link(box_.process(), "link");
  ASSERT_TRUE(link.frozen());

  const std::string status = box_.wait_for("\"stuck\":\"the robot's link\"", kLong);

  EXPECT_TRUE(has(status, "\"stuck\":\"the robot's link\"")) << status;
  EXPECT_TRUE(starves(milliseconds(1500)));
}

TEST_F(Supervision, EachWayToDieLeavesABoxThatWaitsAndIsCounted) {
  // Kept in a folder of the test's, as systemd names one to a service.
  std::filesystem::create_directory(box_.folder().path("state"));
  const support::EnvironmentVariable state("STATE_DIRECTORY", box_.folder().path("state"));
  box_.write_settings("script = true\n");
  int start = 0;
  for (const int signal : {SIGKILL, SIGABRT, SIGSEGV}) {
    ++start;
    ASSERT_TRUE(box_.start_and_wait()) << box_.said();
    const std::string numbered = "boot 1, start " + std::to_string(start);
    EXPECT_TRUE(has(box_.said(), "tubesightd: " + numbered + "\n")) << box_.said();
    const std::string status = box_.wait_for("\"state\":\"tracking\"", kLong);
    ASSERT_TRUE(has(status, "\"state\":\"tracking\"")) << status;
    EXPECT_TRUE(has(status, R"("boot":{"known":true,"number":1,"start":)" + std::to_string(start)))
        << status;
    box_.signal(signal);
    ASSERT_EQ(box_.wait_for_end(kLong), -1);
  }

  box_.write_settings("");  // nobody names tubes
  ASSERT_TRUE(box_.start_and_wait()) << box_.said();
  EXPECT_TRUE(has(box_.wait_for("\"tracking\":", kLong), "\"state\":\"waiting\""));
  EXPECT_TRUE(has(box_.wait_for("\"judged_fields\":0", kLong), "\"judged_fields\":0"));
}

TEST_F(Supervision, TestsItselfAtTheStartAndSaysWhatIsBad) {
  const support::EnvironmentVariable state("STATE_DIRECTORY", box_.folder().path("none"));
  box_.write_settings(
      "[realtime]\npriority = 0\nlock_memory = false\n"
      "[record]\nfolder = \"kept\"\nmemory_mb = 64\n");
  ASSERT_TRUE(box_.start_and_wait()) << box_.said();

  // The others have their time, ten seconds, as two things stay bad.
  const std::string status = box_.wait_for("\"self_test\":{\"finished\":true", kLong);

  ASSERT_TRUE(has(status, R"("self_test":{"finished":true)")) << status;
  EXPECT_TRUE(has(box_.said(), "self-test: bad: ")) << box_.said();
  EXPECT_TRUE(has(box_.said(), "/boots: cannot be written: No such file or directory"))
      << box_.said();
  const std::string rows = box_.ask({"self-test"}).out;
  EXPECT_TRUE(has(rows, "numbers   good   the golden recording is judged as on every machine"))
      << rows;
  EXPECT_TRUE(has(rows, "disk      bad    ")) << rows;
  EXPECT_TRUE(has(rows, "boots     bad    boots are not numbered: ")) << rows;
}

TEST_F(Supervision, GoesOnWhenNobodyListensAnyMoreAndWithoutAHardwareThatIsNoWatchdog) {
  box_.write_settings("[watchdog]\ndevice = \"/dev/null\"\n");
  ASSERT_TRUE(box_.start_and_wait()) << box_.said();
  manager_.close();

  const std::string status = box_.wait_for("\"lost\":1", kLong);

  EXPECT_TRUE(has(status, R"("device":"/dev/null","armed":false)")) << status;
  EXPECT_TRUE(has(box_.said(), "watchdog: /dev/null: is no watchdog: ")) << box_.said();
  EXPECT_TRUE(has(box_.said(), "service manager: cannot be told how the box is doing")) << status;
  EXPECT_TRUE(has(box_.ask({"self-test"}).out, "watchdog  bad")) << "it was wanted";
  box_.signal(SIGTERM);
  EXPECT_EQ(box_.wait_for_end(kLong), 0) << box_.said();
}

}  // namespace
}  // namespace tubesight::tests
