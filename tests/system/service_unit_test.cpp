// What a service manager does by the unit file that is installed: a box that was killed leaves its
// lamp lit, and the command that the unit has for its end makes it dark. No service manager runs
// here; its command is read from the file. The kernel's PWM is a folder in the place of /sys/class.

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>

#include "tests/system/daemon.h"

namespace tubesight::tests {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr const char* kUnit = TUBESIGHT_SOURCE_DIR "/board/visionbox/tubesightd.service";
constexpr const char* kSettings = "/etc/tubesight/box.toml";
/// From the death of a box to the dark.
constexpr milliseconds kSoonest{1000};
constexpr const char* kPeriod = "500000";  // of 2000 pulses a second, ns

/// The values of a key of the unit, in their order.
std::vector<std::string> values_of(const std::string& key) {
  std::ifstream unit(kUnit);
  std::vector<std::string> values;
  for (std::string line; std::getline(unit, line);) {
    if (line.starts_with(key + "=")) {
      values.push_back(line.substr(key.size() + 1));
    }
  }
  return values;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

/// A folder that looks like the kernel's, with one chip whose channel is exported, in the place of
/// /sys/class for this process and those that it starts. Empty: it is so; else what is in the way.
std::string put_in_place(const std::string& classes) {
  if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) {
    return std::string("unshare: ") + std::strerror(errno) +
           "; this test needs a mount namespace: run it as root, or allow users namespaces";
  }
  if (mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount(classes.c_str(), "/sys/class", nullptr, MS_BIND | MS_REC, nullptr) != 0) {
    return std::string("mount: ") + std::strerror(errno);
  }
  return {};
}

class ServiceUnit : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(box_.folder().path("devices/fe20c000.pwm"));
    fs::create_directories(channel_);
    fs::create_directory_symlink(box_.folder().path("devices/fe20c000.pwm"),
                                 box_.folder().path("class/pwm/pwmchip0/device"));
    box_.folder().write("class/pwm/pwmchip0/npwm", "1\n");
    for (const char* file : {"duty_cycle", "period", "enable"}) {
      box_.folder().write(kChannel + std::string(file), "0\n");
    }
    box_.folder().write(kChannel + std::string("polarity"), "normal\n");
    write_settings("");
    ASSERT_EQ(put_in_place(box_.folder().path("class")), "");
  }

  /// What is mounted on has to be there for the next one.
  void TearDown() override { umount2("/sys/class", MNT_DETACH); }

  /// A box with a lamp, whose camera is away.
  void write_settings(const std::string& more) const {
    box_.folder().write("box.toml", "include = [\"" TUBESIGHT_TEST_DATA_DIR
                                    "/recordings/square_flush/session.toml\"]\n"
                                    "[control]\nsocket = \"box\"\n"
                                    "[source]\nkind = \"v4l2\"\ndevice = \"serial:none\"\n"
                                    "[lamp]\nkind = \"pwm\"\nchip = \"fe20c000.pwm\"\n"
                                    "channel = 0\nsoft_ms = 0\n" +
                                        more);
  }

  /// What the kernel would read: the first line.
  [[nodiscard]] std::string duty() const {
    std::istringstream text(box_.folder().read(kChannel + std::string("duty_cycle")));
    std::string line;
    std::getline(text, line);
    return line;
  }

  [[nodiscard]] bool shines_within(milliseconds timeout) const {
    const auto until = Clock::now() + timeout;
    while (duty() != kPeriod && Clock::now() < until) {
      std::this_thread::sleep_for(milliseconds(5));
    }
    return duty() == kPeriod;
  }

  /// Runs a command of the unit with the program that was built and the settings of this test.
  [[nodiscard]] Answered run(const std::string& command) const {
    std::vector<std::string> words = words_of(command);
    EXPECT_GE(words.size(), 2U) << command;
    EXPECT_EQ(words[0], "tubesightd") << command;
    EXPECT_EQ(words[1], kSettings) << command;
    words.erase(words.begin());
    words[0] = box_.settings();
    return run_program(TUBESIGHT_DAEMON, words);
  }

  static constexpr const char* kChannel = "class/pwm/pwmchip0/pwm0/";
  Daemon box_;
  std::string channel_ = box_.folder().path("class/pwm/pwmchip0/pwm0");
};

TEST_F(ServiceUnit, MakesTheLampOfAKilledBoxDarkWithinASecond) {
  const std::vector<std::string> starts = values_of("ExecStart");
  const std::vector<std::string> ends = values_of("ExecStopPost");
  ASSERT_EQ(starts, std::vector<std::string>{std::string("tubesightd ") + kSettings});
  ASSERT_EQ(ends.size(), 1U);
  ASSERT_TRUE(box_.start_and_wait()) << box_.said();
  ASSERT_TRUE(shines_within(seconds(10))) << duty() << "\n" << box_.said();

  const auto killed = Clock::now();
  box_.signal(SIGKILL);
  ASSERT_EQ(box_.wait_for_end(seconds(10)), -1);
  EXPECT_EQ(duty(), kPeriod) << "the hardware goes on";
  const Answered darkened = run(ends[0]);
  const auto took = Clock::now() - killed;

  std::printf("dark %.0f ms after the kill\n", std::chrono::duration<double>(took).count() * 1e3);
  EXPECT_EQ(darkened.status, 0) << darkened.err;
  EXPECT_EQ(darkened.err, "");
  EXPECT_EQ(duty(), "0");
  EXPECT_LE(took, kSoonest);
  EXPECT_EQ(run(ends[0]).status, 0) << "after a clean end, too";
}

TEST_F(ServiceUnit, MakesItDarkWhateverElseIsWrongInTheSettingsMeanwhile) {
  ASSERT_TRUE(box_.start_and_wait()) << box_.said();
  ASSERT_TRUE(shines_within(seconds(10))) << duty() << "\n" << box_.said();
  write_settings("[realtime]\npriority = 1000\n");
  box_.signal(SIGKILL);
  ASSERT_EQ(box_.wait_for_end(seconds(10)), -1);

  const Answered darkened = run(values_of("ExecStopPost").at(0));

  EXPECT_EQ(darkened.status, 2);
  EXPECT_NE(darkened.err.find("realtime.priority: 1000"), std::string::npos) << darkened.err;
  EXPECT_EQ(duty(), "0") << "a mistake elsewhere is no reason to leave it lit";
}

TEST_F(ServiceUnit, TouchesNothingWhereTheLampIsNotKnown) {
  box_.folder().write(kChannel + std::string("duty_cycle"), std::string(kPeriod) + "\n");
  write_settings("channel = 1\n");

  const Answered darkened = run(values_of("ExecStopPost").at(0));

  EXPECT_EQ(darkened.status, 2) << "a key twice";
  EXPECT_EQ(duty(), kPeriod);
}

TEST(ServiceUnitFile, WaitsForTheBoxToSayThatItIsReadyAndKillsOneThatStandsStill) {
  EXPECT_EQ(values_of("Type"), std::vector<std::string>{"notify"});
  EXPECT_EQ(values_of("NotifyAccess"), std::vector<std::string>{"main"});
  EXPECT_EQ(values_of("WatchdogSec"), std::vector<std::string>{"5"});
}

TEST(ServiceUnitFile, StartsAgainWhatFailedButNotWrongSettings) {
  EXPECT_EQ(values_of("Restart"), std::vector<std::string>{"on-failure"});
  EXPECT_EQ(values_of("RestartPreventExitStatus"), std::vector<std::string>{"2"});
  EXPECT_EQ(values_of("StartLimitIntervalSec"), std::vector<std::string>{"0"});
}

}  // namespace
}  // namespace tubesight::tests
