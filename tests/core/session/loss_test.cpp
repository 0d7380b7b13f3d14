// Sequences in which the box must not answer: it coasts within its bound, then is lost openly, and
// never names a wrong tube (SheetRun looks at that in every field).

#include <gtest/gtest.h>

#include "tests/core/session/sheet_run.h"

namespace tubesight::core::session {
namespace {

class Loss : public ::testing::Test {
 protected:
  void SetUp() override {
    run_.configure();
    run_.begin();
  }

  // A move along x at `speed` that has reached it; `t` counts from a moment of constant speed.
  static ToolPlace cruising(double t, double speed) {
    return moved(kOverTube, speed * (t + speed / 2500.0 / 2.0));
  }
  // Steps from rest until the tool cruises.
  void cruise(double speed) {
    const double ramp = speed / 2500.0;
    for (t_ = -ramp; t_ < 0.05; t_ += kFieldSpan_s) {
      const double since = t_ + ramp;
      const ToolPlace place =
          t_ < 0.0 ? moved(kOverTube, 1250.0 * since * since) : cruising(t_, speed);
      run_.step(place);
      ASSERT_EQ(run_.sighting().state, TrackState::kTracking);
    }
  }

  void black(bool on) {
    run_.sheet->look.gain = on ? 0.0 : 1.0;
    run_.sheet->look.offset = on ? 4.0 : 0.0;
  }
  void white(bool on) {
    run_.sheet->look.gain = on ? 0.0 : 1.0;
    run_.sheet->look.offset = on ? 255.0 : 0.0;
  }
  [[nodiscard]] TrackState state() const { return run_.sighting().state; }
  [[nodiscard]] Reason reason() const { return run_.sighting().reason; }

  // Whatever comes, it does not return by itself.
  void expect_stays_lost(const ToolPlace& place) {
    for (int i = 0; i < 20; ++i) {
      run_.step(place);
      EXPECT_EQ(state(), TrackState::kLost) << "field " << i << " after the loss";
    }
  }

  SheetRun<FixedPoint> run_;
  double t_ = 0.0;
};

TEST_F(Loss, CoastsThroughAShortBlackStretchWithItsReason) {
  black(true);
  for (int i = 0; i < 2; ++i) {
    run_.step(kOverTube);
    EXPECT_EQ(state(), TrackState::kDegraded) << i;
    EXPECT_EQ(reason(), Reason::kDark) << i;
    EXPECT_FALSE(run_.sighting().aligned) << "never while coasting";
    EXPECT_EQ(run_.sighting().tracked, 0);
    EXPECT_TRUE(run_.output().tubes.empty());
  }
  black(false);
  run_.step(kOverTube);
  EXPECT_EQ(state(), TrackState::kTracking);
  EXPECT_EQ(reason(), Reason::kNone);
  EXPECT_TRUE(run_.sighting().aligned);
}

TEST_F(Loss, CoastsThroughABlackStretchOnTheMove) {
  cruise(150.0);
  for (int i = 0; i < 8; ++i, t_ += kFieldSpan_s) {
    black(i == 1 || i == 2);
    run_.step(cruising(t_, 150.0));
    EXPECT_EQ(state(), i == 1 || i == 2 ? TrackState::kDegraded : TrackState::kTracking) << i;
  }
}

TEST_F(Loss, CoastsThroughAWashedOutField) {
  white(true);
  run_.step(kOverTube);
  EXPECT_EQ(state(), TrackState::kDegraded);
  EXPECT_EQ(reason(), Reason::kWashedOut);
  white(false);
  run_.step(kOverTube);
  EXPECT_EQ(state(), TrackState::kTracking);
}

TEST_F(Loss, CoastsThroughADamagedFieldWithoutLookingAtIt) {
  run_.draw(moved(kOverTube, 12.7, 12.7));
  run_.status = FieldStatus::kDamaged;
  run_.step_on_last_picture(kOverTube);
  EXPECT_EQ(state(), TrackState::kDegraded);
  EXPECT_EQ(reason(), Reason::kDamagedField);
  EXPECT_FALSE(run_.sighting().aligned);
  run_.step(kOverTube);
  EXPECT_EQ(state(), TrackState::kTracking);
}

TEST_F(Loss, LosesTrackOpenlyAfterALongBlackStretch) {
  black(true);
  int degraded = 0;
  for (int i = 0; i < 30; ++i) {
    run_.step(kOverTube);
    degraded += state() == TrackState::kDegraded ? 1 : 0;
    EXPECT_FALSE(run_.sighting().aligned);
  }
  // 3000 mm/s^2 for 0.1 s are 15 mm, over 0.4 of 25.4 mm: six fields are too many, two are not.
  EXPECT_GE(degraded, 2);
  EXPECT_LE(degraded, 6);
  EXPECT_EQ(state(), TrackState::kLost);
  EXPECT_EQ(reason(), Reason::kCoasted);
  black(false);
  expect_stays_lost(kOverTube);
  EXPECT_EQ(reason(), Reason::kCoasted);
}

TEST_F(Loss, IsLostByAJumpOfHalfAPitch) {
  // A field or two may be passed over as torn ones would be, then it is said.
  for (int i = 0; i < 6; ++i) {
    run_.step(moved(kOverTube, 12.7));
    EXPECT_NE(state(), TrackState::kTracking) << i;
    EXPECT_FALSE(run_.sighting().aligned) << i;
  }
  EXPECT_EQ(state(), TrackState::kLost);
  expect_stays_lost(moved(kOverTube, 12.7));
}

// Jumps between two fields, at rest and on the move, as shares of the pitch along both steps.
struct Jump {
  double x;
  double y;
};

class LossByJump : public Loss, public ::testing::WithParamInterface<Jump> {};

INSTANTIATE_TEST_SUITE_P(Shares, LossByJump,
                         ::testing::Values(Jump{0.2, 0.0}, Jump{0.3, 0.0}, Jump{0.0, 0.4},
                                           Jump{0.5, 0.5}, Jump{0.0, -0.5}, Jump{0.6, 0.0},
                                           Jump{0.7, 0.0}, Jump{0.0, -0.7}, Jump{0.7, 0.7},
                                           Jump{0.8, 0.0}, Jump{-0.5, 1.0}, Jump{1.5, 0.0},
                                           Jump{0.3, -0.7}));

TEST_P(LossByJump, NeverSlipsByATubeAtRest) {
  const ToolPlace there = moved(kOverTube, GetParam().x * kPitch_mm, GetParam().y * kPitch_mm);
  for (int i = 0; i < 10; ++i) {
    run_.step(there);
  }
  if (std::hypot(GetParam().x, GetParam().y) >= 0.5) {
    EXPECT_EQ(state(), TrackState::kLost);
  }
}

TEST_P(LossByJump, NeverSlipsByATubeOnTheMove) {
  cruise(200.0);
  for (int i = 0; i < 10; ++i, t_ += kFieldSpan_s) {
    run_.step(moved(cruising(t_, 200.0), GetParam().x * kPitch_mm, GetParam().y * kPitch_mm));
  }
  if (std::hypot(GetParam().x, GetParam().y) >= 0.5) {
    EXPECT_EQ(state(), TrackState::kLost);
  }
}

TEST_P(LossByJump, NeverSlipsByATubeAfterCoasting) {
  // The mean velocity is older after a gap and the reach larger: it must not grow from a picture
  // that refuted it.
  for (int i = 0; i < 3; ++i) {
    run_.status = FieldStatus::kDamaged;
    run_.step(kOverTube);
  }
  run_.step(kOverTube);
  ASSERT_EQ(state(), TrackState::kTracking);
  const ToolPlace there = moved(kOverTube, GetParam().x * kPitch_mm, GetParam().y * kPitch_mm);
  for (int i = 0; i < 10; ++i) {
    run_.step(there);
  }
  if (std::hypot(GetParam().x, GetParam().y) >= 0.5) {
    EXPECT_EQ(state(), TrackState::kLost);
  }
}

class LossByGap : public Loss, public ::testing::WithParamInterface<int> {};

INSTANTIATE_TEST_SUITE_P(Fields, LossByGap, ::testing::Values(1, 2, 3, 4, 5, 6, 8, 12, 20, 60, 90));

TEST_P(LossByGap, GoesOnOrIsLostButNeverWrongWithFieldsMissingOnTheMove) {
  cruise(200.0);
  const int missing = GetParam();
  run_.drop(missing);
  t_ += missing * kFieldSpan_s;
  for (int i = 0; i < 6; ++i, t_ += kFieldSpan_s) {
    run_.step(cruising(t_, 200.0));
  }
  if (missing == 1) {
    EXPECT_EQ(state(), TrackState::kTracking);
  }
  if (missing >= 6) {
    EXPECT_EQ(state(), TrackState::kLost);
    EXPECT_EQ(reason(), Reason::kGap);
  }
}

TEST_P(LossByGap, GoesOnOrIsLostButNeverWrongWithAStopInTheGap) {
  // The tool stops, or turns back, while nobody looks.
  cruise(200.0);
  const int missing = GetParam();
  const double ramp = 200.0 / 2500.0;
  run_.drop(missing);
  for (int i = 0; i < 6; ++i) {
    const double since = std::min((missing + i) * kFieldSpan_s, ramp);
    const double braked = 200.0 * since - 1250.0 * since * since;
    run_.step(moved(cruising(t_, 200.0), braked));
  }
}

TEST_F(Loss, IsNeverWrongWhenThePictureFreezesOnTheMove) {
  // The same field again and again with time running on: as if 200 mm/s had stopped at once.
  cruise(200.0);
  run_.draw(cruising(t_, 200.0));
  run_.step_on_last_picture(cruising(t_, 200.0));
  for (int i = 0; i < 20; ++i) {
    t_ += kFieldSpan_s;
    run_.sequence += 1;  // the same lines, so the same parity
    run_.now += kFieldSpan;
    run_.step_on_last_picture(cruising(t_, 200.0));
  }
  EXPECT_EQ(state(), TrackState::kLost);
}

TEST_F(Loss, TakesAFieldDeliveredTwiceForNoProgressAndStaysRight) {
  run_.sequence -= 2;
  run_.now -= kFieldSpan;
  run_.step(kOverTube);
  EXPECT_NE(state(), TrackState::kWaiting);
  for (int i = 0; i < 3; ++i) {
    run_.step(kOverTube);  // SheetRun looks for wrong answers
  }
}

TEST_F(Loss, IsLostWhenTimeRunsBackwards) {
  run_.now -= std::chrono::milliseconds(500);
  run_.step(kOverTube);
  EXPECT_EQ(state(), TrackState::kLost);
  EXPECT_EQ(reason(), Reason::kTime);
  expect_stays_lost(kOverTube);
}

TEST_F(Loss, IsLostWhenSequenceNumbersAreMissingThatTheClockDoesNotShow) {
  run_.sequence += 60;

  run_.step(kOverTube);

  EXPECT_EQ(state(), TrackState::kLost);
  EXPECT_EQ(reason(), Reason::kGap);
}

TEST_F(Loss, IsLostWhenSequenceNumbersRunBackwards) {
  run_.sequence -= 4;

  run_.step(kOverTube);

  EXPECT_EQ(state(), TrackState::kLost);
  EXPECT_EQ(reason(), Reason::kSequence);
}

TEST_F(Loss, HasTheTimeAsItsReasonWhereBothRunBackwards) {
  run_.sequence -= 4;
  run_.now -= std::chrono::milliseconds(70);

  run_.step(kOverTube);

  EXPECT_EQ(reason(), Reason::kTime);
}

TEST_F(Loss, ByAGapIsSaidWhereTheClockAloneShowsIt) {
  run_.now += std::chrono::milliseconds(200);

  run_.step(kOverTube);

  EXPECT_EQ(state(), TrackState::kLost);
  EXPECT_EQ(reason(), Reason::kGap);
}

TEST_F(Loss, IsLostAfterALeapOfTheClock) {
  run_.now += std::chrono::hours(24 * 365);
  run_.step(kOverTube);
  EXPECT_EQ(state(), TrackState::kLost);
  EXPECT_EQ(reason(), Reason::kGap);
}

TEST_F(Loss, IsLostAboveTheLimitOfSpeed) {
  // 2500 mm/s^2 are allowed, 600 mm/s are not: the limit is 300 and a little.
  double speed = 0.0;
  for (int i = 0; i < 40; ++i) {
    const double t = i * kFieldSpan_s;
    const double ramp = std::min(t, 600.0 / 2500.0);
    speed = 2500.0 * ramp;
    run_.step(moved(kOverTube, 1250.0 * ramp * ramp + 600.0 * (t - ramp)));
    if (state() == TrackState::kLost) {
      break;
    }
  }
  EXPECT_EQ(state(), TrackState::kLost);
  EXPECT_GE(speed, 300.0) << "lost within the limits";
}

TEST_F(Loss, EndsWithANewStartOnly) {
  for (int i = 0; i < 6; ++i) {
    run_.step(moved(kOverTube, 12.7));
  }
  ASSERT_EQ(state(), TrackState::kLost);
  const ToolPlace there = moved(kOverTube, 3 * kPitch_mm);
  expect_stays_lost(there);

  run_.begin(there);

  EXPECT_EQ(run_.sighting().tool, (TubeAddress{20, 13}));
  EXPECT_TRUE(run_.sighting().aligned);
}

TEST_F(Loss, OfTheTubeEndsToABlankSheetIsNoReasonToGuess) {
  for (std::int32_t row = 0; row < 40; ++row) {
    for (std::int32_t column = 0; column < 40; ++column) {
      run_.sheet->look.flush_plugs.push_back({row, column});
    }
  }
  for (int i = 0; i < 12; ++i) {
    run_.step(kOverTube);
    EXPECT_FALSE(run_.sighting().aligned);
    EXPECT_NE(state(), TrackState::kTracking);
  }
  EXPECT_EQ(state(), TrackState::kLost);
}

TEST_F(Loss, OfContactToRandomPicturesIsNeverAnAnswer) {
  run_.sheet->look.gain = 0.0;
  run_.sheet->look.offset = 90.0;
  run_.sheet->look.noise = 60.0;
  for (int i = 0; i < 12; ++i) {
    run_.step(kOverTube);
    EXPECT_FALSE(run_.sighting().aligned) << i;
  }
  EXPECT_EQ(state(), TrackState::kLost);
}

// Speeds beyond what Mm<FixedPoint> holds, 2048 mm/s, within limits that the settings allow: the
// fixed-point instance must not answer with the saturated number.
template <typename S>
TrackState after_too_fast_a_step(Reason& reason) {
  SheetRun<S> run;
  run.settings->motion = {2000.0, 1.0e6};
  run.configure();
  run.add_start(kOverTube, {{20, 10}, {21, 10}, {20, 11}});
  run.step(kOverTube);
  EXPECT_EQ(run.sighting().state, TrackState::kTracking);
  run.now += std::chrono::microseconds(1200) - kFieldSpan;
  run.step(moved(kOverTube, 2.55));  // 2,125 mm/s
  reason = run.sighting().reason;
  return run.sighting().state;
}

TEST(LossByArithmetic, IsSaidWhenANumberLeavesItsFormat) {
  Reason reason = Reason::kNone;
  EXPECT_EQ(after_too_fast_a_step<double>(reason), TrackState::kTracking);
  EXPECT_EQ(after_too_fast_a_step<FixedPoint>(reason), TrackState::kLost);
  EXPECT_EQ(reason, Reason::kArithmetic);
}

}  // namespace
}  // namespace tubesight::core::session
