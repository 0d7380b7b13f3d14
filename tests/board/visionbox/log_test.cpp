#include "board/visionbox/log.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tubesight::board {
namespace {

TEST(Log, SaysSingleLines) {
  Log log(false);
  testing::internal::CaptureStderr();
  log.say("one\nline");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "tubesightd: one line\n");
}

TEST(Log, SaysTheSameAFewTimesAndThenHowOften) {
  Log log(false);
  testing::internal::CaptureStderr();
  const MonotonicTime now = std::chrono::hours(1);
  for (int i = 0; i < 1000; ++i) {
    log.say_at(std::to_string(i) + " fields came late", now + i * std::chrono::milliseconds(10));
  }
  log.say_at("another", now + std::chrono::seconds(30));
  log.tell_repeats(now + std::chrono::seconds(61));
  log.say_at("1 fields came late", now + std::chrono::seconds(62));
  const std::string said = testing::internal::GetCapturedStderr();

  EXPECT_EQ(said,
            "tubesightd: 0 fields came late\ntubesightd: 1 fields came late\n"
            "tubesightd: 2 fields came late\ntubesightd: 3 fields came late\n"
            "tubesightd: another\n"
            "tubesightd: 999 fields came late (said 1000 times in 61 s)\n"
            "tubesightd: 1 fields came late\n");
  EXPECT_EQ(log.left_out(), 996);
}

TEST(Log, LeavesOutWhatComesTooFastAndTellsSo) {
  Log log(false);
  testing::internal::CaptureStderr();
  const MonotonicTime now = std::chrono::hours(1);
  for (int i = 0; i < 1000; ++i) {
    log.say_at(std::string(static_cast<std::size_t>(i / 2), 'x') + (i % 2 == 0 ? "y" : "z"), now);
  }
  log.say_at("later", now + std::chrono::seconds(60));
  const std::string said = testing::internal::GetCapturedStderr();

  EXPECT_EQ(log.left_out(), 980);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 22);
  EXPECT_NE(said.find("tubesightd: 980 lines left out\ntubesightd: later\n"), std::string::npos);
}

TEST(Log, CutsALineThatIsTooLong) {
  Log log(false);
  testing::internal::CaptureStderr();
  log.say(std::string(10'000, 'x'));
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "tubesightd: " + std::string(800, 'x') + " ...\n");
}

TEST(Log, TellsTheJournalHowMuchALineMatters) {
  Log log(true);
  testing::internal::CaptureStderr();
  log.say("started, 1.2");
  log.say("link: cannot be opened: /dev/ttyS0: No such file or directory");
  log.say("memory is not locked: too little");
  log.say("supervision: stands still: the tracking; the watchdogs are not fed");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "<6>tubesightd: started, 1.2\n"
            "<3>tubesightd: link: cannot be opened: /dev/ttyS0: No such file or directory\n"
            "<4>tubesightd: memory is not locked: too little\n"
            "<2>tubesightd: supervision: stands still: the tracking; the watchdogs are not fed\n");
}

TEST(Log, KnowsTheJournalByWhatSystemdTells) {
  unsetenv("JOURNAL_STREAM");
  EXPECT_FALSE(stderr_is_journal());
  struct stat status {};
  ASSERT_EQ(fstat(STDERR_FILENO, &status), 0);
  const std::string own = std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
  setenv("JOURNAL_STREAM", own.c_str(), 1);
  EXPECT_TRUE(stderr_is_journal());
  setenv("JOURNAL_STREAM", (own + "0").c_str(), 1);
  EXPECT_FALSE(stderr_is_journal()) << "standard error was led elsewhere since";
  setenv("JOURNAL_STREAM", "nonsense", 1);
  EXPECT_FALSE(stderr_is_journal());
  unsetenv("JOURNAL_STREAM");
}

}  // namespace
}  // namespace tubesight::board
