// Cameras of every size: a session on drawn fields against the truth of the same scene, from the
// smallest picture to the largest, by fields and whole, at up to 120 fields a second.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/session/session.h"
#include "tests/core/rendering/center_errors.h"
#include "tests/support/drawn_sheet.h"
#include "tests/support/events.h"

namespace tubesight::core::rendering {
namespace {

using session::Input;
using session::Output;
using session::Session;
using tests::DrawnSheet;

struct Size {
  std::int32_t width_px;
  std::int32_t height_px;
  Scan scan;
  int fields_per_s;
  Weld weld = Weld::kFlush;
};

std::ostream& operator<<(std::ostream& out, const Size& size) {
  return out << size.width_px << "x" << size.height_px
             << (size.scan == Scan::kProgressive ? "p" : "i") << size.fields_per_s
             << (size.weld == Weld::kFillet ? "Fillet" : "Flush");
}

constexpr double kRest_s = 0.05;
constexpr double kMove_s = 0.3;
constexpr double kShutter_s = 0.002;

class PictureSizes : public ::testing::TestWithParam<Size> {
 protected:
  // The same sensor and lens with other columns and lines.
  void configure() {
    Scene& scene = sheet_.scene();
    CameraSettings& camera = scene.camera;
    columns_ = GetParam().width_px / 635.0;
    lines_ = GetParam().height_px / 480.0;
    camera.width_px = GetParam().width_px;
    camera.height_px = GetParam().height_px;
    camera.scan = GetParam().scan;
    camera.cell_width_mm /= columns_;
    camera.cell_height_mm /= lines_;
    camera.center_px = {(camera.center_px[0] + 0.5) * columns_ - 0.5,
                        (camera.center_px[1] + 0.5) * lines_ - 0.5};
    scene.sheet.weld = GetParam().weld;
    ASSERT_TRUE(sheet_.configure());
    settings_->camera = camera;
    settings_->tool = scene.tool;
    settings_->tubesheet = scene.sheet;
    settings_->start.window_px = {
        static_cast<std::int32_t>(40 * columns_), static_cast<std::int32_t>(36 * lines_),
        static_cast<std::int32_t>(595 * columns_), static_cast<std::int32_t>(330 * lines_)};
    settings_->start.optimum_px = {318.0 * columns_, 190.0 * lines_};
    ASSERT_TRUE(session_->configure(*settings_).has_value());
    picture_ = sheet_.picture();
  }

  // Rest, then to the next column with the S of a cosine: 170 mm/s, 1800 mm/s^2; rest.
  static Transform<frames::Sheet, frames::Tool> pose(double t) {
    constexpr double kTurn = 2.0 * 3.14159265358979;
    const double share = std::clamp((t - kRest_s) / kMove_s, 0.0, 1.0);
    const double way = share - std::sin(kTurn * share) / kTurn;
    return {rotation_from_degrees({2.0, 0.2 * way, -0.15}),
            {60 * 25.4 + 0.4 + 25.4 * way, 40 * 25.4 - 0.3, -60.0}};
  }

  void click() {
    Start start;
    for (const TubeAddress& tube :
         {TubeAddress{40, 60}, TubeAddress{41, 60}, TubeAddress{40, 61}}) {
      const auto at =
          sheet_.truth().image_of(pose(0.0), sheet_.truth().tube_ends().at(tube).center_mm);
      ASSERT_TRUE(at.has_value());
      ASSERT_TRUE(
          start.tubes.try_push_back({tube, {(*at)[0] + 4.0 * columns_, (*at)[1] - 3.0 * lines_}}));
    }
    ASSERT_TRUE(input_.events.try_push_back(tests::event_of(start)));
  }

  void run() {
    configure();
    click();
    fields_ = static_cast<int>((2.0 * kRest_s + kMove_s) * GetParam().fields_per_s) + 1;
    for (int field = 0; field < fields_; ++field) {
      step(field);
      check(pose(static_cast<double>(field) / GetParam().fields_per_s), field);
    }
  }

  void step(int field) {
    const double t = static_cast<double>(field) / GetParam().fields_per_s;
    Exposure exposure;
    exposure.opened = pose(t - 0.5 * kShutter_s);
    exposure.closed = pose(t + 0.5 * kShutter_s);
    exposure.parity = parity_of(GetParam().scan, field % 2 == 1);
    exposure.noise_seed = static_cast<std::uint64_t>(field);
    const auto& window = settings_->start.window_px;
    const auto margin = static_cast<std::int32_t>(24 * columns_);
    exposure.window = {window[0] - margin, window[1] - margin, window[2] + margin,
                       window[3] + margin};
    sheet_.renderer().render(exposure, sheet_.view(picture_));
    input_.field.pixels =
        field_of({picture_.data(), GetParam().width_px, GetParam().height_px, GetParam().width_px},
                 exposure.parity);
    input_.field.parity = exposure.parity;
    input_.field.sequence = field;
    input_.field.mid_exposure = std::chrono::nanoseconds(1'000'000'000 + std::llround(1e9 * t));
    session_->step(input_, output_);
    input_.events.clear();
  }

  void check(const Transform<frames::Sheet, frames::Tool>& T_sheet_tool, int field) {
    const Sighting& s = output_.sighting;
    const auto axis = sheet_.truth().axis(T_sheet_tool);
    ASSERT_TRUE(axis.has_value());
    EXPECT_EQ(s.state, TrackState::kTracking) << "field " << field;
    EXPECT_EQ(s.tool_known, true) << "field " << field;
    EXPECT_EQ(s.tool, axis->nearest.address) << "field " << field;
    aligned_ += s.aligned ? 1 : 0;
    truly_aligned_ += axis->nearest.offset_mm <= 2.5 ? 1 : 0;
    const auto center = sheet_.truth().tube_ends().lattice_point(s.tool);
    for (std::size_t i = 0; i < 2; ++i) {
      const double off = s.displacement_um_q8[i] / 256e3 - (axis->axis_mm[i] - center[i]);
      offset2_ += off * off;
    }
    centers_.add(sheet_.truth(), T_sheet_tool, output_.tubes);
  }

  [[nodiscard]] double offset_rms_mm() const { return std::sqrt(offset2_ / fields_); }

  DrawnSheet sheet_;
  std::unique_ptr<SessionSettings> settings_ = std::make_unique<SessionSettings>();
  std::unique_ptr<Session<FixedPoint>> session_ = std::make_unique<Session<FixedPoint>>();
  Input input_;
  Output output_;
  std::vector<std::uint8_t> picture_;
  double columns_ = 1.0;
  double lines_ = 1.0;
  int fields_ = 0;
  int aligned_ = 0;
  int truly_aligned_ = 0;
  CenterErrors centers_;
  double offset2_ = 0.0;
};

TEST_P(PictureSizes, AreTrackedRightlyThroughAMove) {
  run();

  EXPECT_NEAR(aligned_, truly_aligned_, 2);
  ASSERT_GT(centers_.count(), 20 * fields_);
  // A pixel of the smallest picture is 0.35 mm. Larger ones are no worse in pixels.
  EXPECT_LT(centers_.rms_px(), 0.14);
  EXPECT_LT(offset_rms_mm(), GetParam().width_px < 640 ? 0.1 : 0.02);
  RecordProperty("center_rms_millipx", static_cast<int>(1000.0 * centers_.rms_px()));
  RecordProperty("offset_rms_um", static_cast<int>(1000.0 * offset_rms_mm()));
}

class UnevenSheet : public PictureSizes {};

// Its tube-ends are off by more pixels in a larger picture, and by no more of the sheet.
TEST_P(UnevenSheet, IsStartedOnAndTracked) {
  Scene& scene = sheet_.scene();
  scene.look.bore_spread_mm = 0.12;
  for (const DisplacedTube& tube :
       {DisplacedTube{{39, 60}, {0.5, 0.3, -0.8}}, DisplacedTube{{40, 62}, {-0.4, 0.4, -1.0}},
        DisplacedTube{{41, 61}, {0.0, -0.5, 0.6}}}) {
    ASSERT_TRUE(scene.displaced.try_push_back(tube));
  }
  run();

  EXPECT_NEAR(aligned_, truly_aligned_, 2);
  EXPECT_LT(offset_rms_mm(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, UnevenSheet,
                         ::testing::Values(Size{640, 480, Scan::kProgressive, 60},
                                           Size{1920, 1200, Scan::kEvenFirst, 60}),
                         ::testing::PrintToStringParamName());

INSTANTIATE_TEST_SUITE_P(All, PictureSizes,
                         ::testing::Values(Size{320, 240, Scan::kEvenFirst, 60},
                                           Size{320, 240, Scan::kProgressive, 30},
                                           Size{640, 480, Scan::kProgressive, 60},
                                           Size{720, 576, Scan::kOddFirst, 50},
                                           Size{1280, 1024, Scan::kProgressive, 60},
                                           Size{1280, 1024, Scan::kProgressive, 60, Weld::kFillet},
                                           Size{1920, 1080, Scan::kProgressive, 30},
                                           Size{1920, 1200, Scan::kEvenFirst, 60, Weld::kFillet},
                                           Size{1920, 1200, Scan::kProgressive, 120}),
                         ::testing::PrintToStringParamName());

}  // namespace
}  // namespace tubesight::core::rendering
