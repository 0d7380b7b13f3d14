#include "board/visionbox/self_test_watch.h"

#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint16_t bit(drivers::SelfTestBit name) {
  return static_cast<std::uint16_t>(1U << static_cast<unsigned>(name));
}

/// A box without camera, link and recorder that has found nothing wrong.
BoxReport sound() {
  BoxReport report;
  report.turned = true;
  report.source_kind = "replay";
  report.source = SourceState::kPlaying;
  report.span = milliseconds(20);
  report.fields_per_s = 50.0;
  report.link_kind = "none";
  report.deadline_ms = 10.0;
  report.tracking.grab_to_sighting.add(milliseconds(1));
  report.golden = {true, true, "good"};
  report.boots.boot = 17;
  report.boots.start = 2;
  report.boots.wanted = true;
  return report;
}

class SelfTestWatchTest : public testing::Test {
 protected:
  void look(MonotonicTime up) {
    report_.up = up;
    watch_.look(report_);
  }
  BoxReport report_ = sound();
  std::vector<std::string> told_;
  SelfTestWatch watch_{[this](const std::string& line) { told_.push_back(line); }};
};

TEST_F(SelfTestWatchTest, FinishesAtOnceWhereNothingIsBad) {
  look(milliseconds(100));

  EXPECT_TRUE(watch_.finished());
  EXPECT_EQ(told_, std::vector<std::string>{"self-test: nothing is bad"});
  EXPECT_EQ(watch_.told().verdict, drivers::Health::kWell);
  EXPECT_EQ(watch_.told().bad, 0);
  using enum drivers::SelfTestBit;
  EXPECT_EQ(watch_.told().absent, bit(kIdentity) | bit(kLamp) | bit(kPattern) | bit(kLink) |
                                      bit(kDisk) | bit(kPairs) | bit(kPriority) | bit(kMemory) |
                                      bit(kWatchdog) | bit(kJournal));
  EXPECT_EQ(watch_.told().boot, 17);
  EXPECT_EQ(watch_.told().start, 2);
}

TEST_F(SelfTestWatchTest, GivesASlowCameraItsTimeAndTellsOnce) {
  report_.source = SourceState::kOpening;
  look(milliseconds(100));
  look(seconds(5));
  EXPECT_FALSE(watch_.finished());
  EXPECT_EQ(watch_.told().verdict, drivers::Health::kUnknown);
  EXPECT_TRUE(told_.empty());

  look(seconds(10));

  EXPECT_TRUE(watch_.finished());
  EXPECT_EQ(watch_.told().verdict, drivers::Health::kFailed);
  EXPECT_EQ(watch_.told().bad, bit(drivers::SelfTestBit::kCamera));
  EXPECT_EQ(told_, std::vector<std::string>{"self-test: bad: source: replay, opening"});
  report_.source = SourceState::kPlaying;
  look(seconds(11));
  EXPECT_EQ(watch_.told().verdict, drivers::Health::kWell) << "what is bad is bad at present";
  EXPECT_EQ(told_.size(), 1U);
}

TEST_F(SelfTestWatchTest, WaitsForTheLampsPatternAndNoLonger) {
  report_.pattern_wanted = true;
  report_.tracking.lamp = true;
  look(seconds(1));
  EXPECT_FALSE(watch_.finished());
  report_.tracking.sighting.liveness = core::Liveness::kProved;
  look(seconds(2));
  EXPECT_TRUE(watch_.finished());
  EXPECT_EQ(watch_.told().bad, 0);
  report_.tracking.sighting.liveness = core::Liveness::kFailed;

  look(seconds(3));

  EXPECT_EQ(watch_.told().bad, bit(drivers::SelfTestBit::kPattern));
}

TEST_F(SelfTestWatchTest, AFailedGoldenRecordingIsBad) {
  report_.golden = {true, false, "judged otherwise"};

  look(seconds(10));

  EXPECT_EQ(watch_.told().bad, bit(drivers::SelfTestBit::kNumbers));
  EXPECT_EQ(told_, std::vector<std::string>{"self-test: bad: numbers: judged otherwise"});
}

TEST_F(SelfTestWatchTest, LooksOnceASecond) {
  look(seconds(1));
  report_.golden.good = false;
  look(milliseconds(1900));
  EXPECT_EQ(watch_.told().bad, 0);
  look(seconds(2));
  EXPECT_NE(watch_.told().bad, 0);
}

}  // namespace
}  // namespace tubesight::board
