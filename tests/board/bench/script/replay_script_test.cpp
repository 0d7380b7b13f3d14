#include "board/bench/script/replay_script.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "board/bench/script/scripted_ports.h"
#include "tests/support/events.h"
#include "tests/support/recording_text.h"

namespace tubesight::board {
namespace {

using tests::content_of;
using tests::is;

/// A recording of 4 by 4 pixels at 25 frames a second, its events, and who plays them.
class ReplayScriptTest : public ::testing::Test {
 protected:
  void SetUp() override {
    start_.tubes.clear();
    ASSERT_TRUE(start_.tubes.try_push_back({{2, 7}, {1.0, 2.0}}));
    ASSERT_TRUE(grabber_.start());
  }

  void record(const std::string& rows) {
    drivers::Messages messages;
    ASSERT_TRUE(events_.parse("field,time_s,kind,values\n" + rows, "events", messages));
  }

  void grab() { ASSERT_TRUE(grabber_.grab_for(std::chrono::milliseconds(0))); }

  static core::CameraSettings camera() {
    core::CameraSettings camera;
    camera.width_px = 4;
    camera.height_px = 4;
    camera.scan = core::Scan::kEvenFirst;
    return camera;
  }

  std::string text_ = support::recording_text("YUV4MPEG2 W4 H4 F25:1 It Cmono", 4, 16);
  drivers::ReplayFrameGrabber grabber_{camera(), support::source_of(text_), "r", ""};
  drivers::ReplayEvents events_;
  core::StartSettings start_;
};

TEST_F(ReplayScriptTest, BeginsWithTheSettingsStart) {
  ReplayScript script(start_, events_, grabber_);
  grab();

  ASSERT_NE(script.next(), nullptr);
  EXPECT_EQ(script.next()->origin, core::EventOrigin::kOperator);
  const auto start = content_of<core::Start>(*script.next());
  ASSERT_EQ(start.tubes.size(), 1);
  EXPECT_EQ(start.tubes[0].address, (core::TubeAddress{2, 7}));
  script.take();
  EXPECT_EQ(script.next(), nullptr);
}

TEST_F(ReplayScriptTest, GivesRowsUpToTheFieldGrabbed) {
  record("0,,claim,\"1,0\"\n1,,claim,\"2,0\"\n");
  ReplayScript script(start_, events_, grabber_);
  grab();
  script.take();

  ASSERT_NE(script.next(), nullptr);
  EXPECT_EQ(content_of<core::Claim>(*script.next()).tube.row, 1);
  script.take();
  EXPECT_EQ(script.next(), nullptr);
  grab();
  ASSERT_NE(script.next(), nullptr);
  EXPECT_EQ(content_of<core::Claim>(*script.next()).tube.row, 2);
  EXPECT_EQ(events_.left(), 1U);
}

TEST_F(ReplayScriptTest, IsPlayedInItsOwnOrderByRobotAndOperator) {
  record("0,,claim,\"1,0\"\n0,,pick,\"3,4\"\n0,,claim,\"2,0\"\n");
  ReplayScript script(start_, events_, grabber_);
  ScriptedRobotLink link(script);
  ScriptedOperatorStation station(script);
  ASSERT_TRUE(link.start());
  ASSERT_TRUE(station.start());
  grab();

  std::vector<char> who;
  while (script.next() != nullptr) {
    if (const auto said = link.poll_event(); said && said->has_value()) {
      who.push_back('r');
    }
    if (const auto done = station.poll_event(); done && done->has_value()) {
      who.push_back('o');
    }
  }

  EXPECT_EQ(who, (std::vector<char>{'o', 'r', 'o', 'r'}));
}

TEST_F(ReplayScriptTest, OfASessionThatGoesOnKeepsTheOrderInWhichABoxTookItsEvents) {
  // The operator's came while the robot's was taken, and is of before it.
  record("0,0.9,claim,\"1,0\"\n0,0.5,pick,\"3,4\"\n0,0.7,claim,\"2,0\"\n");
  ReplayScript script(start_, events_, grabber_);
  script.leave_start_out();
  ScriptedRobotLink link(script, ScriptedRobotLink::Rows::kAll);
  ASSERT_TRUE(link.start());
  grab();

  std::vector<std::int64_t> instants;
  while (script.next() != nullptr) {
    const auto said = link.poll_event();
    ASSERT_TRUE(said && said->has_value());
    instants.push_back((*said)->at.value_or(core::FieldTime(0)).count());
  }

  EXPECT_EQ(instants, (std::vector<std::int64_t>{900'000'000, 500'000'000, 700'000'000}));
}

TEST_F(ReplayScriptTest, GivesRowsWithoutAnInstantTheirFields) {
  record("1,,claim,\"1,0\"\n");
  ReplayScript script(start_, events_, grabber_);
  ScriptedRobotLink link(script);
  ASSERT_TRUE(link.start());
  grab();
  script.take();
  grab();

  const auto said = link.poll_event();

  ASSERT_TRUE(said);
  ASSERT_TRUE(said->has_value());
  EXPECT_EQ((*said)->at, core::FieldTime(std::chrono::milliseconds(20)));
}

TEST_F(ReplayScriptTest, IsPlayedByNobodyBeforeTheStart) {
  ReplayScript script(start_, events_, grabber_);
  ScriptedOperatorStation station(script);
  grab();

  const auto polled = station.poll_event();

  ASSERT_FALSE(polled);
  EXPECT_EQ(polled.error(), core::Error::kNotReady);
  EXPECT_FALSE(station.send_reply({}));
  ASSERT_TRUE(station.start());
  EXPECT_FALSE(station.start());
  EXPECT_TRUE(station.send_reply({}));
  EXPECT_NE(script.next(), nullptr) << "the row is still there";
}

}  // namespace
}  // namespace tubesight::board
