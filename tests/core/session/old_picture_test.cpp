// Pictures that come again, and pictures that refute the prediction: the box passes over them and
// names nothing until two agree.

#include <gtest/gtest.h>

#include "tests/core/session/sheet_run.h"

namespace tubesight::core::session {
namespace {

class OldPicture : public ::testing::Test {
 protected:
  void start_at_rest(double noise) {
    run_.configure();
    run_.sheet->look.noise = noise;
    run_.begin();
    for (int i = 0; i < 4; ++i) {
      run_.step(kOverTube);
    }
    ASSERT_EQ(run_.sighting().state, TrackState::kTracking);
  }
  // Speeds up by 1500 mm/s^2, within [motion].
  static ToolPlace speeding_up(int field) {
    const double t = field * kFieldSpan_s;
    return moved(kOverTube, 750.0 * t * t);
  }

  SheetRun<FixedPoint> run_;
};

TEST_F(OldPicture, IsNotBelievedWhileTheToolSpeedsUp) {
  start_at_rest(1.5);
  // The frame store delivers its last frame on; the tool goes 0.2, 0.8, 1.9, 3.3 ... mm.
  for (int field = 1; field <= 8; ++field) {
    run_.step_on_last_picture(speeding_up(field));
    EXPECT_NE(run_.sighting().state, TrackState::kTracking) << field;
    EXPECT_FALSE(run_.sighting().aligned) << field;
    if (run_.sighting().state == TrackState::kDegraded) {
      EXPECT_EQ(run_.sighting().reason, Reason::kDamagedField) << field;
    }
  }
  EXPECT_EQ(run_.sighting().state, TrackState::kLost);
  EXPECT_EQ(run_.sighting().reason, Reason::kCoasted);
}

TEST_F(OldPicture, IsFoundBesideALiveStrip) {
  start_at_rest(1.5);
  for (int field = 1; field <= 8; ++field) {
    run_.step_on_held_picture(speeding_up(field), 0.85);
    EXPECT_FALSE(run_.sighting().aligned) << field;
  }
  EXPECT_EQ(run_.sighting().state, TrackState::kLost);
}

TEST_F(OldPicture, OfOneFrameIsPassedOver) {
  start_at_rest(1.5);
  run_.step_on_last_picture(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kDegraded);
  run_.step_on_last_picture(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kDegraded);
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kTracking);
  EXPECT_TRUE(run_.sighting().aligned);
}

TEST_F(OldPicture, IsRightAtRestWhereTheCameraHasNoNoise) {
  start_at_rest(0.0);
  for (int i = 0; i < 20; ++i) {
    run_.step_on_last_picture(kOverTube);
    EXPECT_EQ(run_.sighting().state, TrackState::kTracking) << i;
    EXPECT_TRUE(run_.sighting().aligned) << i;
  }
}

TEST_F(OldPicture, TwoFieldsMustAgreeBehindOneThatRefutesThePrediction) {
  start_at_rest(1.5);
  ToolPlace turned = kOverTube;
  turned.alpha_deg += 4.0;  // in one field: no tool turns so fast
  run_.draw(turned);
  run_.step_on_last_picture(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kDegraded);
  EXPECT_FALSE(run_.sighting().tool_known);
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kDegraded) << "one alone proves nothing";
  EXPECT_FALSE(run_.sighting().tool_known);
  EXPECT_FALSE(run_.sighting().aligned);
  run_.step(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kTracking);
  EXPECT_TRUE(run_.sighting().aligned);
}

TEST_F(OldPicture, IsOneOfAnotherPlaceThatEndsTheTrack) {
  start_at_rest(1.5);
  run_.draw(moved(kOverTube, 9.0, 7.0));  // where no tool can be, and where most tube-ends fit
  run_.step_on_last_picture(kOverTube);
  EXPECT_EQ(run_.sighting().state, TrackState::kLost);
  EXPECT_EQ(run_.sighting().reason, Reason::kNoTubes);
}

}  // namespace
}  // namespace tubesight::core::session
