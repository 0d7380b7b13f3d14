#include "core/picture/rim_measurement.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/picture/sheet_view.h"
#include "core/pose/tool_answer.h"
#include "tests/core/pose/still_picture.h"

namespace tubesight::core::picture {
namespace {

using pose::kStillPlace;
using pose::kUnderTube;
using pose::StillPicture;

class RimMeasurementOf : public ::testing::Test {
 protected:
  RimMeasurementOf() { still_.sheet->look.noise = 1.0; }

  /// Measures a tube-end from a prediction that is 0.1 mm off.
  RimFinding measure(TubeAddress address) {
    still_.draw(kStillPlace);
    const AveragedPicture picture = still_.averaged();
    const tests::ToolPlace& p = kStillPlace;
    const Transform<frames::Sheet, frames::Tool> T_sheet_tool(
        rotation_from_degrees({p.alpha_deg, p.beta_deg, p.gamma_deg}),
        {p.x_mm + 0.1, p.y_mm, -p.height_mm});
    const SheetView view(still_.model.camera, still_.model.T_camera_tool * T_sheet_tool.inverse());
    EXPECT_TRUE(project_rim(view, still_.model.center_mm(address), still_.model.bore_mm / 2.0, 5.0,
                            outline_));
    return measure_rim(picture, outline_, {}, rim_);
  }

  /// How far the points are from the drawn rim, mm.
  double worst_off_mm(TubeAddress address) {
    const auto center = still_.sheet->center_of(address);
    double worst = 0.0;
    for (const RimPoint& point : rim_.points) {
      const auto at = still_.sheet->sheet_point(kStillPlace, {point.u_px, point.v_px});
      const double radius = std::hypot((*at)[0] - center[0], (*at)[1] - center[1]);
      worst = std::max(worst, std::abs(radius - still_.settings->tubesheet.bore_mm / 2.0));
    }
    return worst;
  }

  StillPicture still_;
  RimOutline outline_;
  Rim rim_;
};

TEST_F(RimMeasurementOf, AnOpenTubeEndIsOnItsRimAllAround) {
  EXPECT_EQ(measure(kUnderTube), RimFinding::kMeasured);

  EXPECT_GT(rim_.points.size(), 25);
  EXPECT_LT(worst_off_mm(kUnderTube), 0.1);  // a quarter of a pixel
}

TEST_F(RimMeasurementOf, AFilletWeldIsItsInnerEdge) {
  still_.sheet->look.fillet = true;

  const RimFinding finding = measure(kUnderTube);

  EXPECT_TRUE(finding == RimFinding::kMeasured || finding == RimFinding::kPartly);
  EXPECT_LT(worst_off_mm(kUnderTube), 0.08);
}

TEST_F(RimMeasurementOf, ATubeEndHalfHiddenKeepsTheArcThatIsSeen) {
  const auto at = still_.sheet->image_of(kStillPlace, kUnderTube);
  const auto u = static_cast<std::int32_t>(at[0]);
  const auto v = static_cast<std::int32_t>(at[1]);
  still_.sheet->look.bar_px = {u + 12, v - 60, u + 70, v + 60};

  EXPECT_EQ(measure(kUnderTube), RimFinding::kPartly);

  EXPECT_GT(rim_.points.size(), 10);
  EXPECT_LT(worst_off_mm(kUnderTube), 0.08);
}

TEST_F(RimMeasurementOf, AFlushPlugIsBright) {
  still_.sheet->look.flush_plugs = {kUnderTube};

  EXPECT_EQ(measure(kUnderTube), RimFinding::kBright);
  EXPECT_EQ(rim_.points.size(), 0);
}

TEST_F(RimMeasurementOf, ARolledPlugIsNoTubeEnd) {
  still_.sheet->look.rolled_plugs = {kUnderTube};

  const RimFinding finding = measure(kUnderTube);

  EXPECT_TRUE(finding == RimFinding::kBright || finding == RimFinding::kNoEdge);
}

TEST_F(RimMeasurementOf, ATubeEndFarAwayIsTooSmall) {
  EXPECT_EQ(measure({36, 10}), RimFinding::kTooSmall);
}

}  // namespace
}  // namespace tubesight::core::picture
