// The vision box on drawn fields: what it says of them against the truth of the same scene.

#include "core/session/session.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/rendering/center_errors.h"
#include "tests/support/drawn_sheet.h"
#include "tests/support/events.h"

namespace tubesight::core::rendering {
namespace {

using session::Input;
using session::Output;
using session::Session;
using tests::DrawnSheet;

constexpr double kFieldSpan_s = 1.0 / 60.0;
constexpr double kShutter_s = 0.004;

class DrawnSession : public ::testing::Test {
 protected:
  /// The pose `t` seconds after the start: rest, a move with the S of a cosine, rest.
  Transform<frames::Sheet, frames::Tool> pose(double t) const {
    const double share = std::clamp((t - 0.1) / move_s_, 0.0, 1.0);
    const double way = share - std::sin(2.0 * 3.14159265358979 * share) / (2.0 * 3.14159265358979);
    return {rotation_from_degrees({2.0, 0.2 * way, -0.15}),
            {from_mm_[0] + way * by_mm_[0], from_mm_[1] + way * by_mm_[1], -60.0 - 3.0 * way}};
  }

  void start() {
    ASSERT_TRUE(sheet_.configure());
    settings_->camera = sheet_.scene().camera;
    settings_->tool = sheet_.scene().tool;
    settings_->tubesheet = sheet_.scene().sheet;
    settings_->start.window_px = {40, 36, 595, 330};
    settings_->start.optimum_px = {318.0, 190.0};
    ASSERT_TRUE(session_->configure(*settings_).has_value());
    const auto axis = sheet_.truth().axis(pose(0.0));
    ASSERT_TRUE(axis.has_value());
    const TubeAddress under = axis->nearest.address;
    Start start;
    for (const TubeAddress& tube : {under, TubeAddress{under.row + 1, under.column},
                                    TubeAddress{under.row, under.column + 1}}) {
      const auto at =
          sheet_.truth().image_of(pose(0.0), sheet_.truth().tube_ends().at(tube).center_mm);
      ASSERT_TRUE(at.has_value());
      ASSERT_TRUE(start.tubes.try_push_back({tube, {(*at)[0] + 4.0, (*at)[1] - 3.0}}));
    }
    ASSERT_TRUE(input_.events.try_push_back(tests::event_of(start)));
  }

  void run(int fields) {
    start();
    for (int field = 0; field < fields; ++field) {
      const double t = field * kFieldSpan_s;
      Exposure exposure;
      exposure.opened = pose(t - 0.5 * kShutter_s);
      exposure.closed = pose(t + 0.5 * kShutter_s);
      exposure.parity = field % 2 == 0 ? Parity::kEven : Parity::kOdd;
      exposure.noise_seed = static_cast<std::uint64_t>(field);
      sheet_.renderer().render(exposure, sheet_.view(picture_));
      input_.field.pixels = field_of({picture_.data(), 635, 480, 635}, exposure.parity);
      input_.field.parity = exposure.parity;
      input_.field.sequence = field;
      input_.field.mid_exposure = std::chrono::nanoseconds(1'000'000'000 + field * 16'666'667LL);
      session_->step(input_, output_);
      input_.events.clear();
      check(pose(t), field);
    }
  }

  void check(const Transform<frames::Sheet, frames::Tool>& T_sheet_tool, int field) {
    const Sighting& s = output_.sighting;
    const auto axis = sheet_.truth().axis(T_sheet_tool);
    ASSERT_TRUE(axis.has_value());
    ++fields_;
    tracking_ += s.state == TrackState::kTracking ? 1 : 0;
    aligned_ += s.aligned ? 1 : 0;
    if (s.tool_known) {
      const auto center = sheet_.truth().tube_ends().lattice_point(s.tool);
      const double off = std::hypot(center[0] - axis->axis_mm[0], center[1] - axis->axis_mm[1]);
      EXPECT_LT(off, axis->nearest.offset_mm + 0.3) << "a wrong tube in field " << field;
    }
    if (s.aligned) {
      EXPECT_EQ(s.tool, axis->nearest.address) << field;
    }
    centers_.add(sheet_.truth(), T_sheet_tool, output_.tubes);
  }

  DrawnSheet sheet_;
  std::unique_ptr<SessionSettings> settings_ = std::make_unique<SessionSettings>();
  std::unique_ptr<Session<FixedPoint>> session_ = std::make_unique<Session<FixedPoint>>();
  Input input_;
  Output output_;
  std::vector<std::uint8_t> picture_ = sheet_.picture();
  std::array<double, 2> from_mm_{60 * 25.4 + 0.4, 40 * 25.4 - 0.3};
  std::array<double, 2> by_mm_{3 * 25.4, 25.4};
  double move_s_ = 0.9;
  CenterErrors centers_;
  int fields_ = 0;
  int tracking_ = 0;
  int aligned_ = 0;
};

TEST_F(DrawnSession, FollowsAMoveOnASquarePitch) {
  run(80);

  EXPECT_EQ(tracking_, 80);
  EXPECT_GT(centers_.count(), 80 * 8);
  EXPECT_LT(centers_.rms_px(), 0.2);
  EXPECT_GE(aligned_, 14);
  EXPECT_EQ(output_.sighting.tool, (TubeAddress{41, 63}));
  RecordProperty("center_rms_millipx", static_cast<int>(1000.0 * centers_.rms_px()));
}

TEST_F(DrawnSession, FollowsAMoveOnATriangularPitchWithPlugs) {
  TubesheetSettings& sheet = sheet_.scene().sheet;
  sheet.row_step_mm = {11.1125, 19.24741459910915};
  sheet.column_step_mm = {22.225, 0.0};
  sheet.bore_mm = 14.2;
  from_mm_ = {60 * 22.225 + 40 * 11.1125 + 0.4, 40 * 19.24741459910915 - 0.3};
  by_mm_ = {3 * 22.225 + 11.1125, 19.24741459910915};
  ASSERT_TRUE(sheet_.scene().plugs.try_push_back({{41, 62}, PlugKind::kFlush}));
  ASSERT_TRUE(sheet_.scene().plugs.try_push_back({{39, 63}, PlugKind::kRolled}));

  run(80);

  EXPECT_EQ(tracking_, 80);
  EXPECT_LT(centers_.rms_px(), 0.2);
  EXPECT_EQ(output_.sighting.tool, (TubeAddress{41, 63}));
  RecordProperty("center_rms_millipx", static_cast<int>(1000.0 * centers_.rms_px()));
}

TEST_F(DrawnSession, FollowsAMoveBetweenFilletWelds) {
  TubesheetSettings& sheet = sheet_.scene().sheet;
  sheet.row_step_mm = {0.0, 32.54};
  sheet.column_step_mm = {32.54, 0.0};
  sheet.bore_mm = 19.7;
  sheet.weld = Weld::kFillet;
  from_mm_ = {60 * 32.54 + 0.4, 40 * 32.54 - 0.3};
  by_mm_ = {2 * 32.54, 32.54};

  run(80);

  EXPECT_EQ(tracking_, 80);
  EXPECT_LT(centers_.rms_px(), 0.2);
  EXPECT_EQ(output_.sighting.tool, (TubeAddress{41, 62}));
  RecordProperty("center_rms_millipx", static_cast<int>(1000.0 * centers_.rms_px()));
}

}  // namespace
}  // namespace tubesight::core::rendering
