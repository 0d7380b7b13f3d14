// How far apart fields may be, and how poor the picture, for a tool at rest to be tracked.

#include <tuple>

#include <gtest/gtest.h>

#include "tests/core/session/sheet_run.h"

namespace tubesight::core::session {
namespace {

// Fields so far apart that the limits of [motion] take the tool to another tube, none missing.
class LossByRate : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Milliseconds, LossByRate, ::testing::Values(60, 67, 100, 200, 900, 1500));

TEST_P(LossByRate, IsNoGap) {
  SheetRun<FixedPoint> run;
  run.configure();
  run.add_start(kOverTube, {{20, 10}, {21, 10}, {20, 11}});
  int lived = 0;
  for (; lived < 5; ++lived) {
    run.step(kOverTube);
    if (run.sighting().state != TrackState::kTracking) {
      break;
    }
    run.now += std::chrono::milliseconds(GetParam()) - kFieldSpan;
  }
  EXPECT_LE(lived, 2);
  EXPECT_EQ(run.sighting().state, TrackState::kLost);
  EXPECT_EQ(run.sighting().reason, Reason::kRate);
}

// Top speed times the time between fields from 0.3 to 0.8 of a step, a poor and a good picture.
class RightAfterAStart : public ::testing::TestWithParam<std::tuple<int, double>> {};
INSTANTIATE_TEST_SUITE_P(SpeedsAndNoises, RightAfterAStart,
                         ::testing::Combine(::testing::Range(30, 85, 5),
                                            ::testing::Values(0.0, 6.0, 15.0)));

TEST_P(RightAfterAStart, AToolAtRestIsTracked) {
  const auto [percent, noise] = GetParam();
  SheetRun<FixedPoint> run;
  constexpr std::chrono::nanoseconds kSpan{33'333'333};
  run.settings->motion = {percent / 100.0 * kPitch_mm * 30.0, 3000.0};
  run.configure();
  run.sheet->look.noise = noise;
  run.add_start(kOverTube, {{20, 10}, {21, 10}, {20, 11}});
  for (int i = 0; i < 8; ++i) {
    run.step(kOverTube);
    EXPECT_EQ(run.sighting().state, TrackState::kTracking) << "field " << i;
    run.now += kSpan - kFieldSpan;
  }
}

}  // namespace
}  // namespace tubesight::core::session
