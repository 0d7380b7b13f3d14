// The lamp's closed loop: a simulated lamp and camera, the box between them, faster than it
// happens. How surely all this is, over hours: tests/benchmark/lamp_study.cpp.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/simulated_bench.h"

namespace tubesight::board {
namespace {

using core::Liveness;
using core::Reason;
using core::TrackState;
using core::lighting::LampCondition;
using drivers::Fault;
using drivers::FaultKind;

constexpr double kFault_s = 5.0;

class LampLoop : public testing::Test {
 protected:
  LampLoop() {
    bench_->scenario.video.window_margin_px = 4;
    bench_->scenario.video.length_s = 40.0;
    bench_->scenario.light.lag_s = 0.07;
    bench_->lamp = {true, true, 5};
  }

  void break_at(FaultKind kind, double at_s = kFault_s, double for_s = 0.0, double level = 0.0) {
    Fault fault;
    fault.kind = kind;
    fault.at_s = at_s;
    fault.for_s = for_s;
    fault.level = level;
    fault.columns = kind == FaultKind::kOtherCamera ? 1 : 0;
    bench_->scenario.faults.push_back(fault);
  }

  /// Seconds of fields until `what` holds; -1: it did not in that time.
  template <typename What>
  double run_until(What what, double longest_s) {
    for (int field = 1; field <= static_cast<int>(longest_s * 60.0) && !HasFatalFailure();
         ++field) {
      bench_->run(1.0 / 60.0);
      if (what()) {
        return field / 60.0;
      }
    }
    return -1.0;
  }
  double run_until(Liveness liveness, double longest_s) {
    return run_until([&] { return bench_->sighting().liveness == liveness; }, longest_s);
  }
  double run_until(LampCondition condition, double longest_s) {
    return run_until([&] { return bench_->output().lamp == condition; }, longest_s);
  }

  std::unique_ptr<tests::SimulatedBench> bench_ = std::make_unique<tests::SimulatedBench>();
};

TEST_F(LampLoop, ProvesTheLivePictureWithinTwoSecondsAtRest) {
  bench_->start();
  const double proved_s = run_until(Liveness::kProved, 4.0);
  EXPECT_GE(proved_s, 0.0);
  EXPECT_LE(proved_s, 2.0);
  EXPECT_LT(run_until(Liveness::kFailed, 5.0), 0.0);
  EXPECT_EQ(bench_->output().lamp, LampCondition::kWell);
  EXPECT_TRUE(bench_->sighting().aligned);
}

TEST_F(LampLoop, ProvesTheLivePictureWithinTenSecondsMoving) {
  bench_->start();
  for (const auto& [row, column] : {std::pair{44, 66}, {36, 56}, {45, 54}, {38, 66}, {46, 60}}) {
    ASSERT_TRUE(bench_->robot().move_to({row, column}));
  }
  const double proved_s = run_until(Liveness::kProved, 12.0);
  EXPECT_GE(proved_s, 0.0);
  EXPECT_LE(proved_s, 10.0);
  EXPECT_FALSE(bench_->robot().at_rest());
  EXPECT_LT(run_until(Liveness::kFailed, 3.0), 0.0);
}

TEST_F(LampLoop, SwingsTheLevelByTwoPercentAtMost) {
  bench_->start();
  bench_->run(4.0);
  std::int32_t least = 1000;
  std::int32_t most = 0;
  for (int i = 0; i < 120; ++i) {
    bench_->run(1.0 / 60.0);
    least = std::min(least, bench_->input().field.lamp_permille);
    most = std::max(most, bench_->input().field.lamp_permille);
  }
  EXPECT_GT(most, least);
  EXPECT_LE((most - least) * 50, most) << least << " to " << most;
}

TEST_F(LampLoop, ACommandedLevelWins) {
  core::Event event;
  event.origin = core::EventOrigin::kOperator;
  event.content = core::LampCommand{500};
  bench_->scenario.events.push_back({1.0, event});
  bench_->start();
  bench_->run(6.0);
  EXPECT_NEAR(bench_->input().field.lamp_permille, 500, 5);
  EXPECT_EQ(bench_->sighting().liveness, Liveness::kProved);
}

TEST_F(LampLoop, AFrozenPictureEndsTheTrackAndIsGotOver) {
  break_at(FaultKind::kFrozen, kFault_s, 6.0);
  bench_->start();
  bench_->run(kFault_s);
  ASSERT_EQ(bench_->sighting().liveness, Liveness::kProved);
  ASSERT_EQ(bench_->sighting().state, TrackState::kTracking);

  const double failed_s = run_until(Liveness::kFailed, 4.0);
  EXPECT_GE(failed_s, 0.0);
  EXPECT_LE(failed_s, 2.0);
  EXPECT_EQ(bench_->output().lamp, LampCondition::kUnseen);
  EXPECT_EQ(bench_->sighting().state, TrackState::kLost);
  EXPECT_EQ(bench_->sighting().reason, Reason::kNotLive);
  EXPECT_FALSE(bench_->sighting().aligned);

  bench_->run(6.0 - failed_s);
  const double proved_s = run_until(Liveness::kProved, 4.0);
  EXPECT_GE(proved_s, 0.0);
  EXPECT_LE(proved_s, 2.0);
  EXPECT_EQ(bench_->output().lamp, LampCondition::kWell);
  EXPECT_EQ(bench_->sighting().state, TrackState::kLost) << "until a new start";
}

TEST_F(LampLoop, AnotherCamerasPictureEndsTheTrack) {
  break_at(FaultKind::kOtherCamera);
  bench_->start();
  bench_->run(kFault_s);
  ASSERT_EQ(bench_->sighting().liveness, Liveness::kProved);

  const double failed_s = run_until(Liveness::kFailed, 10.0);
  EXPECT_GE(failed_s, 0.0);
  EXPECT_LE(failed_s, 2.0) << "though its lamp swings, too, and as slowly";
  EXPECT_EQ(bench_->sighting().state, TrackState::kLost);
  EXPECT_FALSE(bench_->sighting().aligned);
}

TEST_F(LampLoop, ADeadLampIsTold) {
  break_at(FaultKind::kLampOut);
  bench_->start();
  bench_->run(kFault_s);
  const double dark_s = run_until(LampCondition::kDark, 4.0);
  EXPECT_GE(dark_s, 0.0);
  EXPECT_LE(dark_s, 2.0);
}

// To 8 % within 15 s: 30 % are gone after 4.9 s.
TEST_F(LampLoop, AFadingLampIsALampsFaultAndNoLostTrack) {
  break_at(FaultKind::kLampDrift, kFault_s, 15.0, 0.08);
  bench_->start();
  bench_->run(kFault_s);
  const double weak_s = run_until(LampCondition::kWeak, 20.0);
  EXPECT_GE(weak_s, 4.0);
  EXPECT_LE(weak_s, 4.9 + 2.0);
  bench_->run(15.0 - weak_s);
  EXPECT_EQ(bench_->output().lamp, LampCondition::kWeak);
  EXPECT_EQ(bench_->sighting().state, TrackState::kTracking);
  EXPECT_NE(bench_->sighting().liveness, Liveness::kFailed);
  EXPECT_GE(bench_->input().field.lamp_permille, 950) << "it does all it may";
}

TEST_F(LampLoop, WithoutAPolicyNothingIsDoneOrSaid) {
  bench_->lamp = {};
  bench_->start();
  EXPECT_LT(run_until([&] { return bench_->input().field.lamp_permille != 1000; }, 3.0), 0.0);
  EXPECT_EQ(bench_->sighting().liveness, Liveness::kUnknown);
  EXPECT_EQ(bench_->output().lamp, LampCondition::kUnknown);
  EXPECT_FALSE(bench_->output().lamp_ruled);
}

}  // namespace
}  // namespace tubesight::board
