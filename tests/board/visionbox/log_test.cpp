#include "board/visionbox/log.h"

#include <algorithm>
#include <chrono>
#include <string>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

TEST(Log, SaysSingleLines) {
  Log log;
  testing::internal::CaptureStderr();
  log.say("one\nline");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "tubesightd: one line\n");
}

TEST(Log, LeavesOutWhatComesTooFastAndTellsSo) {
  Log log;
  testing::internal::CaptureStderr();
  const MonotonicTime now = std::chrono::hours(1);
  for (int i = 0; i < 1000; ++i) {
    log.say_at("again", now);
  }
  log.say_at("later", now + std::chrono::seconds(60));
  const std::string said = testing::internal::GetCapturedStderr();

  EXPECT_EQ(log.left_out(), 980);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 22);
  EXPECT_NE(said.find("tubesightd: 980 lines left out\ntubesightd: later\n"), std::string::npos);
}

}  // namespace
}  // namespace tubesight::board
