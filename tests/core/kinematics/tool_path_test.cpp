#include "core/kinematics/tool_path.h"

#include <array>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

namespace tubesight::core::kinematics {
namespace {

PathSegment rest(double seconds) {
  PathSegment segment;
  segment.rest_s = seconds;
  return segment;
}

PathSegment move(double x_mm, double y_mm, const SpeedLimits& limits,
                 SpeedShape shape = SpeedShape::kTrapezoid) {
  PathSegment segment;
  segment.kind = SegmentKind::kMove;
  segment.to_mm = {x_mm, y_mm};
  segment.limits = limits;
  segment.shape = shape;
  return segment;
}

PathSegment segment_of(SegmentKind kind, const SpeedLimits& limits) {
  PathSegment segment;
  segment.kind = kind;
  segment.limits = limits;
  return segment;
}

class ToolPathTest : public testing::Test {
 protected:
  void begin(const ToolPlace& place) { ASSERT_TRUE(path_->begin(place)); }
  void add(const PathSegment& segment) { ASSERT_TRUE(path_->add(segment)); }

  std::unique_ptr<ToolPath> path_ = std::make_unique<ToolPath>();
};

TEST_F(ToolPathTest, WithoutSegmentsStaysWhereItBegins) {
  begin({10.0, 20.0, 30.0, 90.0, 0.0, 0.0});

  for (const double time_s : {-5.0, 0.0, 7.0}) {
    const ToolState state = path_->state_at(time_s);

    EXPECT_EQ(state.place, (ToolPlace{10.0, 20.0, 30.0, 90.0, 0.0, 0.0}));
    EXPECT_EQ(state.speed_mm_s, 0.0);
    EXPECT_EQ(state.T_sheet_tool.translation_mm(), Eigen::Vector3d(10.0, 20.0, -30.0))
        << "the tool hangs below the sheet at negative z";
    // A heading of 90 degrees takes the tool's x into the sheet's y.
    EXPECT_NEAR(state.T_sheet_tool.rotation()(1, 0), 1.0, 1e-15);
    EXPECT_NEAR(state.T_sheet_tool.rotation()(0, 1), -1.0, 1e-15);
  }
  EXPECT_EQ(path_->duration_s(), 0.0);
}

TEST_F(ToolPathTest, MovesStraightAtTheSpeedAsked) {
  // 500 mm along (0.6, 0.8): 0.5 s to 250 mm/s over 62.5 mm, 375 mm in 1.5 s, 0.5 s to rest.
  begin({100.0, 200.0, 40.0, 0.0, 0.0, 0.0});
  add(rest(2.0));
  add(move(400.0, 600.0, {250.0, 500.0, 0.0}));

  EXPECT_DOUBLE_EQ(path_->duration_s(), 4.5);
  EXPECT_EQ(path_->state_at(1.0).segment, 0);
  EXPECT_EQ(path_->state_at(1.0).speed_mm_s, 0.0);
  const ToolState middle = path_->state_at(3.25);
  EXPECT_EQ(middle.segment, 1);
  EXPECT_NEAR(middle.place.x_mm, 250.0, 1e-9);
  EXPECT_NEAR(middle.place.y_mm, 400.0, 1e-9);
  EXPECT_NEAR(middle.place.height_mm, 40.0, 1e-12);
  EXPECT_NEAR(middle.velocity_mm_s[0], 150.0, 1e-9);
  EXPECT_NEAR(middle.velocity_mm_s[1], 200.0, 1e-9);
  EXPECT_NEAR(middle.speed_mm_s, 250.0, 1e-9);
  const ToolState rising = path_->state_at(2.25);
  EXPECT_NEAR(rising.acceleration_mm_s2[0], 300.0, 1e-9);
  EXPECT_NEAR(rising.acceleration_mm_s2[1], 400.0, 1e-9);
  EXPECT_NEAR(rising.speed_mm_s, 125.0, 1e-9);
  const ToolState after = path_->state_at(100.0);
  EXPECT_EQ(after.segment, 2);
  EXPECT_EQ(after.place, (ToolPlace{400.0, 600.0, 40.0, 0.0, 0.0, 0.0}));
}

TEST_F(ToolPathTest, DocksUpwardsAndSquare) {
  begin({0.0, 0.0, 50.0, 12.0, 0.5, -1.0});
  PathSegment dock = segment_of(SegmentKind::kDock, {20.0, 1e6, 0.0});
  dock.height_mm = 2.0;
  add(dock);

  const ToolState middle = path_->state_at(0.5 * path_->duration_s());
  EXPECT_NEAR(middle.place.height_mm, 26.0, 1e-9);
  EXPECT_NEAR(middle.place.beta_deg, 0.25, 1e-12);
  EXPECT_NEAR(middle.velocity_mm_s[2], 20.0, 1e-9) << "towards the sheet is along its z";
  EXPECT_EQ(path_->end(), (ToolPlace{0.0, 0.0, 2.0, 12.0, 0.0, 0.0}));
}

TEST_F(ToolPathTest, DocksWhereItOnlyHasToStraighten) {
  begin({0.0, 0.0, 0.0, 0.0, 3.0, 4.0});
  add(segment_of(SegmentKind::kDock, {10.0, 1e6, 0.0}));

  EXPECT_NEAR(path_->duration_s(), 0.5, 1e-4) << "5 degrees at 10 degrees a second";
  EXPECT_EQ(path_->state_at(1.0).place, ToolPlace{});
}

TEST_F(ToolPathTest, TurnsAndLeansInDegrees) {
  begin({});
  PathSegment turn = segment_of(SegmentKind::kTurn, {90.0, 1e9, 0.0});
  turn.alpha_deg = 180.0;
  add(turn);
  PathSegment lean = segment_of(SegmentKind::kLean, {1.0, 1e9, 0.0});
  lean.lean_deg = {0.6, -0.8};
  add(lean);

  EXPECT_NEAR(path_->start_s(1), 2.0, 1e-6);
  EXPECT_NEAR(path_->duration_s(), 3.0, 1e-6);
  const ToolState turning = path_->state_at(1.0);
  EXPECT_NEAR(turning.place.alpha_deg, 90.0, 1e-4);
  EXPECT_EQ(turning.speed_mm_s, 0.0) << "the tip stays";
  EXPECT_EQ(path_->end(), (ToolPlace{0.0, 0.0, 0.0, 180.0, 0.6, -0.8}));
}

TEST_F(ToolPathTest, JumpsInNoTime) {
  begin({});
  add(rest(1.0));
  PathSegment jump;
  jump.kind = SegmentKind::kJump;
  jump.place = {25.4, 0.0, 40.0, 0.0, 0.0, 0.0};
  add(jump);
  add(rest(1.0));

  EXPECT_EQ(path_->state_at(0.999999).place.x_mm, 0.0);
  EXPECT_EQ(path_->state_at(1.0).place.x_mm, 25.4);
  EXPECT_EQ(path_->state_at(1.0).segment, 2);
  EXPECT_EQ(path_->state_at(1.0).speed_mm_s, 0.0);
}

TEST_F(ToolPathTest, SpeedAndAccelerationAreTheRatesOfPlace) {
  begin({0.0, 0.0, 60.0, 0.0, 0.0, 0.0});
  add(move(80.0, -30.0, {200.0, 1500.0, 2e4}, SpeedShape::kSCurve));
  PathSegment height = segment_of(SegmentKind::kHeight, {50.0, 400.0, 5e3});
  height.shape = SpeedShape::kSCurve;
  height.height_mm = 10.0;
  add(height);

  constexpr double kStep_s = 1e-5;
  for (double time_s = 0.00333; time_s < path_->duration_s(); time_s += 0.01) {
    const ToolState before = path_->state_at(time_s - kStep_s);
    const ToolState state = path_->state_at(time_s);
    const ToolState after = path_->state_at(time_s + kStep_s);
    double speed2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const double rate =
          (after.T_sheet_tool.translation_mm()[axis] - before.T_sheet_tool.translation_mm()[axis]) /
          (2.0 * kStep_s);
      EXPECT_NEAR(state.velocity_mm_s[i], rate, 1e-3) << time_s << " axis " << axis;
      const double rate2 = (after.velocity_mm_s[i] - before.velocity_mm_s[i]) / (2.0 * kStep_s);
      EXPECT_NEAR(state.acceleration_mm_s2[i], rate2, 1.0) << time_s << " axis " << axis;
      speed2 += state.velocity_mm_s[i] * state.velocity_mm_s[i];
    }
    EXPECT_NEAR(state.speed_mm_s * state.speed_mm_s, speed2, 1e-9 * (1.0 + speed2));
  }
}

TEST_F(ToolPathTest, FindsTheSegmentInAPathAsLongAsItCanBe) {
  begin({});
  for (std::int32_t i = 0; i < kMaxPathSegments; ++i) {
    ASSERT_TRUE(path_->add(rest(0.5)));
  }

  const auto full = path_->add(rest(0.5));

  ASSERT_FALSE(full);
  EXPECT_EQ(full.error(), Error::kBufferTooSmall);
  EXPECT_EQ(path_->duration_s(), 0.5 * kMaxPathSegments) << "the path is as before";
  for (std::int32_t i = 0; i < kMaxPathSegments; i += 7) {
    EXPECT_EQ(path_->state_at(0.5 * i).segment, i);
    EXPECT_EQ(path_->state_at(0.5 * i + 0.49).segment, i);
  }
}

TEST_F(ToolPathTest, RefusesWhatIsNoPath) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  begin({});
  const auto refused = [&](const PathSegment& segment) {
    const auto added = path_->add(segment);
    return !added && added.error() == Error::kInvalidArgument && path_->size() == 0;
  };

  EXPECT_TRUE(refused(rest(-1.0)));
  EXPECT_TRUE(refused(rest(nan)));
  EXPECT_TRUE(refused(move(nan, 0.0, {})));
  EXPECT_TRUE(refused(move(1.0, 0.0, {0.0, 1.0, 1.0})));
  EXPECT_FALSE(path_->begin({nan, 0.0, 0.0, 0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace tubesight::core::kinematics
