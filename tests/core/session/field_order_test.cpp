// Fields that were not taken in the order that they are told in: no wrong answer (SheetRun looks at
// that in every field), and the reason names the order.

#include <tuple>

#include <gtest/gtest.h>

#include "tests/core/session/sheet_run.h"

namespace tubesight::core::session {
namespace {

enum class Taken { kAsTold, kSwapped, kAtOnce };

/// How much later than told a field was taken, in fields.
double late(bool first, Taken taken) {
  switch (taken) {
    case Taken::kAsTold: return 0.0;
    case Taken::kSwapped: return first ? 1.0 : -1.0;
    case Taken::kAtOnce: return first ? 0.5 : -0.5;
  }
  return 0.0;
}

/// A rest and a column's way at `speed_mm_s`; until the track is lost.
void move(SheetRun<FixedPoint>& run, Scan scan, Taken taken, double speed_mm_s) {
  run.settings->camera.scan = scan;
  run.configure();
  // The first field of a frame comes first: even fields have even numbers in a SheetRun.
  run.sequence += scan == Scan::kOddFirst ? 1 : 0;
  run.begin();
  constexpr double kRest_s = 0.15;
  for (int i = 4; i < 120; ++i) {
    const bool even = run.sequence % 2 == 0;
    const bool first = even == (scan == Scan::kEvenFirst);
    const double t = (i + late(first, taken)) * kFieldSpan_s - kRest_s;
    run.step(moved(kOverTube, way_after(t, kPitch_mm, speed_mm_s, 2000.0)));
    if (run.sighting().state == TrackState::kLost) {
      return;
    }
  }
}

class OrderOfFields : public ::testing::TestWithParam<std::tuple<Scan, double>> {};
INSTANTIATE_TEST_SUITE_P(ScansAndSpeeds, OrderOfFields,
                         ::testing::Combine(::testing::Values(Scan::kEvenFirst, Scan::kOddFirst),
                                            ::testing::Values(6.0, 20.0, 100.0)));

TEST_P(OrderOfFields, IsTheReasonWhereItIsTheOther) {
  const auto [scan, speed] = GetParam();
  SheetRun<FixedPoint> run;
  move(run, scan, Taken::kSwapped, speed);
  EXPECT_EQ(run.sighting().state, TrackState::kLost);
  EXPECT_EQ(run.sighting().reason, Reason::kFieldOrder);
}

TEST_P(OrderOfFields, IsTheReasonWhereBothAreOfOneInstant) {
  const auto [scan, speed] = GetParam();
  SheetRun<FixedPoint> run;
  move(run, scan, Taken::kAtOnce, speed);
  EXPECT_EQ(run.sighting().state, TrackState::kLost);
  EXPECT_EQ(run.sighting().reason, Reason::kFieldOrder);
}

TEST_P(OrderOfFields, IsNoReasonWhereItIsAsTold) {
  const auto [scan, speed] = GetParam();
  SheetRun<FixedPoint> run;
  move(run, scan, Taken::kAsTold, speed);
  EXPECT_EQ(run.sighting().state, TrackState::kTracking);
}

}  // namespace
}  // namespace tubesight::core::session
