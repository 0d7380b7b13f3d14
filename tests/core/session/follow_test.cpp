// Sequences in which the box has to answer, and answer right: drawn sheets with exact truth.

#include <gtest/gtest.h>

#include "tests/core/session/sheet_run.h"
#include "tests/support/scalars.h"

namespace tubesight::core::session {
namespace {

using tests::Scalars;

template <typename S>
class Follow : public ::testing::Test {};
TYPED_TEST_SUITE(Follow, Scalars);

// Rest, a move of 2 columns and a row while the tool rises, rest.
ToolPlace on_the_way(int field, const ToolPlace& from) {
  const double t = (field - 5) * kFieldSpan_s;
  const double length = std::hypot(2.0, 1.0) * kPitch_mm;
  const double share = way_after(t, length, 200.0, 2500.0) / length;
  ToolPlace place = moved(from, share * 2.0 * kPitch_mm, share * kPitch_mm);
  place.height_mm += 8.0 * share;
  return place;
}
constexpr int kFields = 40;

TYPED_TEST(Follow, NamesEveryTubeOfAMoveToATenthOfAMillimetre) {
  SheetRun<TypeParam> run(1);
  run.configure();
  run.sheet->look.noise = 1.0;
  run.add_start(kOverTube, {{20, 10}, {21, 10}, {20, 11}});
  int aligned_at_rest = 0;
  int named = 0;
  for (int field = 0; field < kFields; ++field) {
    const ToolPlace place = on_the_way(field, kOverTube);
    run.step(place);
    const Sighting& s = run.sighting();
    ASSERT_EQ(s.state, TrackState::kTracking) << field;
    EXPECT_GE(s.tracked, 5) << field;
    EXPECT_TRUE(s.primary_known);
    EXPECT_NEAR(run.height_mm(), place.height_mm, 0.15) << field;
    if (s.tool_known) {
      ++named;
      EXPECT_NEAR(run.offset_mm(), run.true_offset_mm(place, s.tool), 0.1) << field;
    }
    if (field < 5 || field > 35) {
      aligned_at_rest += s.aligned ? 1 : 0;
      EXPECT_EQ(s.tool, field < 5 ? kTube : (TubeAddress{21, 12})) << field;
    }
    for (const auto& tube : run.output().tubes) {
      const auto truth = run.sheet->image_of(place, tube.address);
      if (tube.quality_permyriad > 0) {
        EXPECT_NEAR(tube.center_px.u_q16 / 65536.0, truth[0], 0.3);
        EXPECT_NEAR(tube.center_px.v_q16 / 65536.0, truth[1], 0.3);
      }
    }
  }
  EXPECT_EQ(aligned_at_rest, 9);
  EXPECT_GE(named, kFields - 4);  // between two tubes it may hold its tongue
}

TYPED_TEST(Follow, StandsALeanOfOneDegreeEachWay) {
  for (const auto& [beta, gamma] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.7, -0.7}}) {
    SheetRun<TypeParam> run(1);
    run.configure();
    ToolPlace place = kOverTube;
    place.beta_deg = beta;
    place.gamma_deg = gamma;
    // The axis meets the sheet a millimetre beside the tip.
    run.add_start(place, {{20, 10}, {21, 10}, {20, 11}});
    for (int field = 0; field < 4; ++field) {
      run.step(place);
    }
    ASSERT_EQ(run.sighting().state, TrackState::kTracking) << beta << ", " << gamma;
    ASSERT_TRUE(run.sighting().tool_known);
    EXPECT_EQ(run.sighting().tool, kTube);
    EXPECT_NEAR(run.offset_mm(), run.true_offset_mm(place, kTube), 0.3) << beta << ", " << gamma;
    EXPECT_NEAR(run.height_mm(), 60.0, 0.5);
  }
}

TYPED_TEST(Follow, WorksFromDockedTo90MillimetresAndAtAnyHeading) {
  for (const double height : {0.0, 90.0}) {
    for (const double alpha : {90.0, 45.0}) {
      SheetRun<TypeParam> run(1);
      // A docked tool sees few whole tube-ends: the window is the picture.
      run.settings->start.window_px = {8, 8, 626, 471};
      run.configure();
      ToolPlace place = kOverTube;
      place.height_mm = height;
      place.alpha_deg = alpha;
      run.add_start(place, run.middle_tubes(place));
      run.step(place);
      run.step(place);
      ASSERT_EQ(run.sighting().state, TrackState::kTracking)
          << height << ", " << alpha << ", refusal "
          << static_cast<int>(run.session().tracker().start_refusal());
      ASSERT_TRUE(run.sighting().aligned) << height << ", " << alpha;
      EXPECT_EQ(run.sighting().tool, kTube);
      EXPECT_NEAR(run.offset_mm(), 0.5, 0.15);
      EXPECT_NEAR(run.height_mm(), height, 0.3);
    }
  }
}

TEST(FollowInAllArithmetics, AgreesToAHundredthOfAMillimetre) {
  SheetRun<FixedPoint> fixed;
  SheetRun<float> single;
  SheetRun<double> oracle;
  fixed.configure();
  single.configure();
  oracle.configure();
  fixed.begin();
  single.begin();
  oracle.begin();
  for (int field = 0; field < 30; ++field) {
    const ToolPlace place = on_the_way(field, kOverTube);
    fixed.step(place);
    single.step(place);
    oracle.step(place);
    const Sighting& o = oracle.sighting();
    for (const Sighting* s : {&fixed.sighting(), &single.sighting()}) {
      ASSERT_EQ(s->state, o.state) << field;
      EXPECT_EQ(s->tracked, o.tracked) << field;
      EXPECT_EQ(s->primary, o.primary) << field;
      // 1/256 um: 0.01 mm is 2560.
      EXPECT_NEAR(s->height_um_q8, o.height_um_q8, 2560) << field;
      EXPECT_NEAR(s->axis_px.u_q16, o.axis_px.u_q16, 1311) << field;  // 0.02 px
      EXPECT_NEAR(s->axis_px.v_q16, o.axis_px.v_q16, 1311) << field;
      if (s->tool_known && o.tool_known) {
        EXPECT_EQ(s->tool, o.tool) << field;
        EXPECT_NEAR(s->offset_um_q8, o.offset_um_q8, 2560) << field;
      }
    }
  }
}

class FollowFixed : public ::testing::Test {
 protected:
  SheetRun<FixedPoint> run_;
};

TEST_F(FollowFixed, FollowsTheAccelerationOfMotionToItsVeryLimit) {
  run_.settings->motion = {1600.0, 12000.0};
  run_.configure();
  for (int degrees = 0; degrees < 360; degrees += 30) {
    run_.drop(10);  // the time to come back in
    run_.begin();
    const double x = std::cos(degrees * 3.14159265358979 / 180.0);
    const double y = std::sin(degrees * 3.14159265358979 / 180.0);
    // From a field's instant on: the prediction is the whole reach astray in each field.
    for (int field = 1; field <= 8; ++field) {
      const double t = field * kFieldSpan_s;
      run_.step(moved(kOverTube, 6000.0 * t * t * x, 6000.0 * t * t * y));
      ASSERT_EQ(run_.sighting().state, TrackState::kTracking)
          << degrees << " degrees, field " << field;
    }
  }
}

TEST_F(FollowFixed, KeepsThePrimaryTubeUntilAnotherIsNearerByATenth) {
  run_.configure();
  run_.begin();
  TubeAddress primary = run_.sighting().primary;
  const auto& optimum = run_.settings->start.optimum_px;
  int changes = 0;
  for (int field = 0; field < 45; ++field) {
    const ToolPlace place = moved(kOverTube, way_after(field * kFieldSpan_s, 60.0, 120.0, 2500.0));
    run_.step(place);
    ASSERT_EQ(run_.sighting().state, TrackState::kTracking);
    ASSERT_TRUE(run_.sighting().primary_known);
    const auto off = [&](TubeAddress tube) {
      const auto at = run_.sheet->image_of(place, tube);
      return std::hypot(at[0] - optimum[0], at[1] - optimum[1]);
    };
    const TubeAddress now = run_.sighting().primary;
    for (const auto& tube : run_.output().tubes) {
      if (tube.quality_permyriad > 0) {
        EXPECT_LT(off(now), off(tube.address) / 0.9 + 1.5) << "another is nearer by a tenth";
      }
    }
    if (now != primary) {
      ++changes;
      EXPECT_LT(off(now), 0.9 * off(primary) + 1.5) << "changed too early";
      primary = now;
    }
  }
  EXPECT_GE(changes, 1);
}

TEST_F(FollowFixed, SaysNothingOfAVoidAndIsNotAlignedUnderIt) {
  ASSERT_TRUE(run_.settings->tubesheet.missing.try_push_back({20, 12}));
  run_.configure();
  run_.begin();
  int void_fields = 0;
  for (int field = 0; field < 50; ++field) {
    const ToolPlace place =
        moved(kOverTube, way_after(field * kFieldSpan_s, 2 * kPitch_mm, 150.0, 2500.0));
    run_.step(place);
    ASSERT_EQ(run_.sighting().state, TrackState::kTracking) << field;
    if (run_.true_offset_mm(place, {20, 12}) < 10.0) {
      ++void_fields;
      EXPECT_FALSE(run_.sighting().tool_known) << field;
      EXPECT_FALSE(run_.sighting().aligned) << field;
      EXPECT_TRUE(run_.sighting().axis_known) << field;
      EXPECT_NEAR(run_.height_mm(), 60.0, 0.5) << field;
    }
  }
  EXPECT_GE(void_fields, 10);
}

TEST_F(FollowFixed, IsDegradedWithTwoTubesLeftAndStillRight) {
  // A sheet of two columns that ends at row 20: the tool goes beyond the end until the window shows
  // that row alone.
  run_.settings->tubesheet.rows = {20, 23};
  run_.settings->tubesheet.columns = {10, 11};
  run_.configure();
  for (std::int32_t row = 10; row < 32; ++row) {
    for (std::int32_t column = 1; column < 21; ++column) {
      if (row < 20 || row > 23 || column < 10 || column > 11) {
        run_.sheet->look.flush_plugs.push_back({row, column});
      }
    }
  }
  run_.begin();
  int two = 0;
  for (int field = 0; field < 200; ++field) {
    const ToolPlace place =
        moved(kOverTube, 0.0, -way_after(field * kFieldSpan_s, 150.0, 60.0, 1000.0));
    run_.step(place);
    const Sighting& s = run_.sighting();
    if (s.state != TrackState::kTracking && s.state != TrackState::kDegraded) {
      break;
    }
    if (s.tracked == 2) {
      ++two;
      EXPECT_EQ(s.state, TrackState::kDegraded) << field;
      EXPECT_EQ(s.reason, Reason::kFewTubes) << field;
      EXPECT_NEAR(run_.height_mm(), 60.0, 3.0) << field;
    }
  }
  EXPECT_GE(two, 5);
}

TEST_F(FollowFixed, IsNotMisledByUnlistedPlugsOrADisplacedTubeEnd) {
  run_.configure();
  run_.sheet->look.noise = 1.5;
  run_.sheet->look.rolled_plugs = {{21, 12}};
  run_.sheet->look.flush_plugs = {{22, 11}};
  run_.sheet->look.displaced = {{{21, 11}, {1.2, 0.9}}};
  run_.begin();
  bool rejected = false;
  for (int field = 0; field < 40; ++field) {
    const ToolPlace place =
        moved(kOverTube, way_after(field * kFieldSpan_s, 2 * kPitch_mm, 150.0, 2500.0));
    run_.step(place);
    ASSERT_EQ(run_.sighting().state, TrackState::kTracking) << field;
    if (run_.sighting().tool_known) {
      EXPECT_NEAR(run_.offset_mm(), run_.true_offset_mm(place, run_.sighting().tool), 0.3) << field;
    }
    for (const auto& tube : run_.output().tubes) {
      EXPECT_FALSE(tube.address == (TubeAddress{21, 12}) && tube.quality_permyriad > 0) << field;
      EXPECT_FALSE(tube.address == (TubeAddress{22, 11}) && tube.quality_permyriad > 0) << field;
      if (tube.address == TubeAddress{21, 11} && !tube.plug) {
        rejected = rejected || tube.quality_permyriad == 0;
        EXPECT_EQ(tube.quality_permyriad, 0) << "1.5 mm beside its place, field " << field;
      }
    }
  }
  EXPECT_TRUE(rejected);
}

TEST_F(FollowFixed, LooksPastTheGuidetube) {
  run_.configure();
  run_.sheet->look.bar_px = {130, 110, 190, 239};
  run_.add_start(kOverTube, {{20, 10}, {19, 10}, {20, 11}});
  for (int field = 0; field < 40; ++field) {
    const ToolPlace place =
        moved(kOverTube, way_after(field * kFieldSpan_s, 2 * kPitch_mm, 150.0, 2500.0));
    run_.step(place);
    ASSERT_EQ(run_.sighting().state, TrackState::kTracking) << field;
    if (run_.sighting().tool_known) {
      EXPECT_NEAR(run_.offset_mm(), run_.true_offset_mm(place, run_.sighting().tool), 0.3) << field;
    }
  }
}

TEST_F(FollowFixed, FollowsFilletWeldsAndObliqueLeftHandedSteps) {
  auto& sheet = run_.settings->tubesheet;
  sheet.weld = Weld::kFillet;
  sheet.row_step_mm = {16.27, -28.18};
  sheet.column_step_mm = {32.54, 0.0};
  run_.configure();
  const auto start = run_.sheet->center_of({5, 6});
  const ToolPlace from{start[0] + 0.5, start[1] + 0.2, 60.0, 30.0, 0.0, 0.0};
  run_.add_start(from, run_.middle_tubes(from));
  int aligned = 0;
  for (int field = 0; field < 40; ++field) {
    const ToolPlace place =
        moved(from, way_after((field - 3) * kFieldSpan_s, 32.54, 120.0, 2500.0));
    run_.step(place);
    ASSERT_EQ(run_.sighting().state, TrackState::kTracking)
        << field << ", refusal " << static_cast<int>(run_.session().tracker().start_refusal());
    aligned += run_.sighting().aligned ? 1 : 0;
  }
  EXPECT_GE(aligned, 15);
  EXPECT_EQ(run_.sighting().tool, (TubeAddress{5, 7}));
}

TEST_F(FollowFixed, ListsEstimatesAndFindsTubesInThePicture) {
  run_.configure();
  run_.begin();
  const auto& tracker = run_.session().tracker();
  tracking::CandidateList<FixedPoint> estimates;
  tracker.list_estimates(estimates);
  ASSERT_GE(estimates.size(), 8);
  for (const auto& estimate : estimates) {
    const auto truth = run_.sheet->image_of(kOverTube, estimate.address);
    EXPECT_NEAR(static_cast<double>(estimate.center_px.x), truth[0], 0.5);
    EXPECT_NEAR(static_cast<double>(estimate.center_px.y), truth[1], 0.5);
    ImagePoint at;
    ASSERT_TRUE(tracker.locate(estimate.address, at));
  }
}

}  // namespace
}  // namespace tubesight::core::session
