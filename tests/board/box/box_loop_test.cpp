#include "board/box/box_loop.h"

#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/board/box/box_bench.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::FieldStatus;
using core::Parity;

/// A loop on fakes that was started.
class BoxLoopTest : public BoxBench {
 protected:
  void SetUp() override {
    BoxBench::SetUp();
    ASSERT_TRUE(loop_->start());
  }
};

using BoxLoopStart = BoxBench;

TEST_F(BoxLoopStart, LightsTheLampAndOpensTheLines) {
  ASSERT_TRUE(loop_->start());

  EXPECT_EQ(dimmer_.level_permille(), 1000);
  EXPECT_TRUE(link_.poll_event());
  EXPECT_TRUE(station_.poll_event());
  loop_->stop();
  EXPECT_EQ(dimmer_.levels(), (std::vector<std::int32_t>{1000, 0}));
  EXPECT_FALSE(link_.poll_event());
  EXPECT_FALSE(station_.poll_event());
}

/// A lamp that was at one level until an instant, and at another from it on.
class FakeLampHistory final : public hal::LampHistory {
 public:
  explicit FakeLampHistory(core::FieldTime at) : at_(at) {}
  [[nodiscard]] std::int32_t level_permille_at(core::FieldTime instant) const override {
    return instant < at_ ? 250 : 750;
  }

 private:
  core::FieldTime at_;
};

TEST_F(BoxLoopStart, FieldsAreToldTheLightOfTheMiddleOfTheirExposure) {
  const FakeLampHistory history(2 * kSpan);
  ports_.lamp_history = &history;
  make_loop();
  ASSERT_TRUE(loop_->start());

  take_field();
  EXPECT_EQ(loop_->input().field.lamp_permille, 250);
  take_field();
  EXPECT_EQ(loop_->input().field.lamp_permille, 750);
  EXPECT_EQ(dimmer_.level_permille(), 1000) << "and nobody takes that for a wish";
}

TEST_F(BoxLoopStart, StopsWhatItStartedWhenAPortFails) {
  const auto expect_failed = [this](Error error) {
    const auto started = loop_->start();
    ASSERT_FALSE(started);
    EXPECT_EQ(started.error(), error);
    EXPECT_FALSE(link_.poll_event());
    EXPECT_FALSE(station_.poll_event());
    EXPECT_EQ(dimmer_.level_permille(), 0);
  };
  dimmer_.fail_start(Error::kIo);
  expect_failed(Error::kIo);
  dimmer_.fail_level(Error::kDisconnected);
  expect_failed(Error::kDisconnected);
  link_.fail_start(Error::kIo);
  expect_failed(Error::kIo);
  station_.fail_start(Error::kIo);
  expect_failed(Error::kIo);

  EXPECT_TRUE(loop_->start()) << "may be tried again";
}

TEST_F(BoxLoopStart, RefusesASecondStartAndKeepsTheFirst) {
  ASSERT_TRUE(loop_->start());

  const auto again = loop_->start();

  ASSERT_FALSE(again);
  EXPECT_EQ(again.error(), Error::kNotReady);
  EXPECT_EQ(dimmer_.level_permille(), 1000);
  EXPECT_TRUE(link_.poll_event());
}

TEST_F(BoxLoopStart, NeedsNoPortsButTheGrabberAndTheClock) {
  ports_ = {&grabber_, &clock_};
  make_loop();
  ASSERT_TRUE(loop_->start());

  take_field();

  EXPECT_EQ(loop_->counters().fields, 1);
  EXPECT_EQ(loop_->input().field.lamp_permille, 123) << "the grabber's, as nobody dims";
  loop_->stop();
}

TEST_F(BoxLoopTest, TellsTheRobotWhatItSeesAfterEachField) {
  take_field();
  take_field();

  ASSERT_EQ(link_.sightings().size(), 2U);
  EXPECT_EQ(link_.sightings()[1].time, 2 * kSpan);
  EXPECT_EQ(loop_->output().sighting.time, 2 * kSpan);
  EXPECT_EQ(loop_->counters().fields, 2);
  EXPECT_EQ(loop_->counters().missing, 0);
}

TEST_F(BoxLoopTest, StepsWithoutAFieldWhenNoneComesInTime) {
  take_field();
  clock_.advance(kTimeout);
  grabber_.script_error(Error::kTimeout);
  link_.say(claim(7));

  ASSERT_TRUE(loop_->turn(kTimeout));

  EXPECT_EQ(loop_->input().field.status, FieldStatus::kMissing);
  EXPECT_EQ(loop_->input().field.mid_exposure, kSpan + kTimeout);
  EXPECT_EQ(loop_->output().sighting.time, kSpan + kTimeout);
  EXPECT_EQ(loop_->counters().missing, 1);
  EXPECT_EQ(loop_->counters().fields, 2);
  EXPECT_EQ(handed(), (std::vector<std::int64_t>{7})) << "who asks is heard all the same";
  EXPECT_EQ(link_.sightings().size(), 2U);
}

TEST_F(BoxLoopTest, CountsMissingProgressiveFramesInTheNumbers) {
  take_field();  // 0
  grabber_.script_error(Error::kTimeout);
  ASSERT_TRUE(loop_->turn(kTimeout));
  EXPECT_EQ(loop_->input().field.number, 2);

  take_field();

  EXPECT_EQ(loop_->input().field.number, 4);
  EXPECT_EQ(loop_->input().field.status, FieldStatus::kGood);
}

TEST_F(BoxLoopTest, LetsAnInterlacedFrameLackBothFields) {
  expose(Parity::kEven);
  ASSERT_TRUE(loop_->turn(kTimeout));
  expose(Parity::kOdd);
  ASSERT_TRUE(loop_->turn(kTimeout));
  grabber_.script_error(Error::kTimeout);
  expose(Parity::kEven);
  std::vector<std::int64_t> missing;

  ASSERT_TRUE(loop_->turn(kTimeout));
  missing.push_back(loop_->input().field.number);
  ASSERT_TRUE(loop_->turn(kTimeout));
  missing.push_back(loop_->input().field.number);
  EXPECT_EQ(loop_->input().field.status, FieldStatus::kMissing);
  ASSERT_TRUE(loop_->turn(kTimeout));

  EXPECT_EQ(missing, (std::vector<std::int64_t>{2, 3}));
  EXPECT_EQ(loop_->input().field.status, FieldStatus::kGood);
  EXPECT_EQ(loop_->input().field.number, 4) << "an earlier field, so even";
  EXPECT_EQ(loop_->counters().missing, 2);
}

TEST_F(BoxLoopTest, StepsWithADamagedFieldAsItCame) {
  expose(Parity::kProgressive, FieldStatus::kDamaged);

  ASSERT_TRUE(loop_->turn(kTimeout));

  EXPECT_EQ(loop_->input().field.status, FieldStatus::kDamaged);
  EXPECT_EQ(loop_->counters().missing, 0);
}

TEST_F(BoxLoopTest, LeavesTheGrabbersOtherErrorsToTheCaller) {
  take_field();
  link_.say(claim(7));
  for (const Error error :
       {Error::kDisconnected, Error::kIo, Error::kDataLoss, Error::kEndOfData}) {
    support::FakeFrameGrabber failing(635, 480);
    ASSERT_TRUE(failing.start());
    failing.script_error(error);
    ports_.grabber = &failing;
    BoxBench::Loop loop(*session_, ports_);

    const auto turned = loop.turn(kTimeout);

    ASSERT_FALSE(turned);
    EXPECT_EQ(turned.error(), error);
    EXPECT_EQ(loop.counters().fields, 0);
  }
  EXPECT_EQ(link_.sightings().size(), 1U);
  take_field();
  EXPECT_EQ(handed(), (std::vector<std::int64_t>{7})) << "events wait meanwhile";
}

TEST_F(BoxLoopTest, AnswersWhileTheCameraIsAway) {
  grabber_.script_error(Error::kDisconnected);
  ASSERT_FALSE(loop_->turn(kTimeout));
  link_.say(claim(7));

  loop_->turn_without_field();

  EXPECT_EQ(loop_->input().field.status, FieldStatus::kMissing);
  EXPECT_EQ(handed(), (std::vector<std::int64_t>{7}));
  EXPECT_EQ(link_.sightings().size(), 1U);
}

TEST_F(BoxLoopTest, NumbersGoOnWhenTheCameraIsStartedAnew) {
  for (int i = 0; i < 3; ++i) {
    expose(i % 2 == 0 ? Parity::kEven : Parity::kOdd);
    ASSERT_TRUE(loop_->turn(kTimeout));
  }
  ASSERT_EQ(loop_->input().field.number, 2);
  exposed_ = 0;  // as a driver counts
  expose(Parity::kEven);
  expose(Parity::kOdd);

  ASSERT_TRUE(loop_->turn(kTimeout));
  EXPECT_EQ(loop_->input().field.number, 4) << "even again, and never one that was there";
  ASSERT_TRUE(loop_->turn(kTimeout));
  EXPECT_EQ(loop_->input().field.number, 5);
}

TEST_F(BoxLoopTest, ReportsWhatWasCommandedAsTheLevelInForce) {
  take_field();
  EXPECT_EQ(loop_->input().field.lamp_permille, 1000);
  link_.say(tests::event_of(core::LampCommand{640}));

  take_field();
  EXPECT_EQ(loop_->input().field.lamp_permille, 1000) << "that field came before the command";
  EXPECT_EQ(dimmer_.level_permille(), 640);
  take_field();

  EXPECT_EQ(loop_->input().field.lamp_permille, 640);
  EXPECT_EQ(dimmer_.levels(), (std::vector<std::int32_t>{1000, 640})) << "set once";
  ASSERT_EQ(link_.replies().size(), 1U);
  EXPECT_EQ(tests::content_of<core::LampReply>(link_.replies()[0]).permille, 640);
}

TEST_F(BoxLoopStart, WithoutADimmerServesNoLampCommands) {
  ports_.dimmer = nullptr;
  make_loop();
  ASSERT_TRUE(loop_->start());
  link_.say(tests::event_of(core::LampCommand{640}));

  take_field();

  ASSERT_EQ(link_.replies().size(), 1U);
  EXPECT_TRUE(tests::is<core::NotServedReply>(link_.replies()[0]));
}

TEST_F(BoxLoopTest, TriesALevelAgainThatTheDimmerRefused) {
  link_.say(tests::event_of(core::LampCommand{300}));
  dimmer_.fail_level(Error::kIo);

  take_field();
  EXPECT_EQ(loop_->counters().dimmer_errors, 1);
  EXPECT_EQ(dimmer_.level_permille(), 1000);
  take_field();

  EXPECT_EQ(dimmer_.level_permille(), 300);
  EXPECT_EQ(loop_->counters().dimmer_errors, 1);
}

TEST_F(BoxLoopTest, KeepsThePictureAndTheMarksForADisplay) {
  const auto view = std::make_unique<FrameView>(635, 480);
  const auto latest = std::make_unique<core::Snapshot<OverlaySnapshot>>();
  services_.view = view.get();
  services_.overlay = latest.get();
  make_loop();

  take_field();
  take_field();

  const auto shown = std::make_unique<OverlaySnapshot>();
  ASSERT_TRUE(latest->try_read(*shown));
  EXPECT_EQ(latest->version(), 2U);
  EXPECT_EQ(shown->field, 2);
  EXPECT_EQ(shown->sighting.time, 2 * kSpan);
  EXPECT_EQ(view->picture().line(17)[5], 70);
}

}  // namespace
}  // namespace tubesight::board
