#include "board/bench/budget/vision_budget.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/source_camera.h"

namespace tubesight::board {
namespace {

/// The camera and tool of the shipped recording, below a sheet of 25.4 mm.
class VisionBudgetTest : public testing::Test {
 protected:
  VisionBudgetTest() : sheet_(std::make_unique<core::TubesheetSettings>()) {
    core::ToolSettings tool;
    tool.position_mm = {-3.074, 31.629, 112.789};
    tool.rotation_deg = {-0.0639, -0.8174, 47.9947};
    sheet_->row_step_mm = {0.0, 25.4};
    sheet_->column_step_mm = {25.4, 0.0};
    sheet_->bore_mm = 18.6;
    sheet_->rows = {0, 60};
    sheet_->columns = {0, 60};
    const auto model = core::pose::make_pose_model(tests::source_camera(), tool, *sheet_);
    EXPECT_TRUE(model.has_value());
    model_ = *model;
  }

  [[nodiscard]] BudgetShare share(const core::pose::CalibrationUncertainty& uncertainty,
                                  VisionItem item, const VisionAssumptions& assumptions = {}) {
    const auto budget = vision_budget(model_, *sheet_, uncertainty, assumptions);
    EXPECT_TRUE(budget.has_value());
    return budget.value_or({}).shares[static_cast<std::size_t>(item)];
  }

  std::unique_ptr<core::TubesheetSettings> sheet_;
  core::pose::PoseModel model_;
};

TEST_F(VisionBudgetTest, TheTipIsOffAsTheToolIs) {
  core::pose::CalibrationUncertainty uncertainty;
  uncertainty.tool_sigma = {0.3, 0.3, 0.3, 0.0, 0.0, 0.0};

  const BudgetShare tip = share(uncertainty, VisionItem::kToolPlace);

  EXPECT_NEAR(tip.across_mm, 0.3 * std::sqrt(2.0), 1e-9) << "alike in all directions";
  EXPECT_NEAR(tip.along_mm, 0.3, 1e-9);
  EXPECT_EQ(share(uncertainty, VisionItem::kCamera).across_mm, 0.0);
}

TEST_F(VisionBudgetTest, TheAxisIsOffByTheHeight) {
  core::pose::CalibrationUncertainty uncertainty;
  uncertainty.tool_sigma = {0.0, 0.0, 0.0, 0.0, 0.0, 0.1};  // gamma leans the axis, about R's x
  VisionAssumptions assumptions;
  assumptions.height_mm = 50.0;

  EXPECT_NEAR(share(uncertainty, VisionItem::kToolAxis, assumptions).across_mm,
              50.0 * 0.1 * std::numbers::pi / 180.0, 1e-6);
}

TEST_F(VisionBudgetTest, SharesOfTheCameraAddUpWhereTheyAreIndependent) {
  core::pose::CalibrationUncertainty uncertainty;
  uncertainty.camera_sigma = {0.0002, 1e-5, 0.02, 0.02, 2e-6, 0.0};
  double across2 = 0.0;
  for (int i = 0; i < 6; ++i) {
    const double across = share(uncertainty, static_cast<VisionItem>(i)).across_mm;
    EXPECT_EQ(across > 0.0, i < 5) << i;
    across2 += across * across;
  }
  EXPECT_NEAR(share(uncertainty, VisionItem::kCamera).across_mm, std::sqrt(across2), 1e-9);
}

TEST_F(VisionBudgetTest, ALongerFocalLengthPutsTheSheetFarther) {
  // At h = 40 mm the sheet is some 160 mm along the axis of a camera that leans by 48 degrees; all
  // distances from the camera grow in proportion to EFL, those along its axis above all.
  core::pose::CalibrationUncertainty uncertainty;
  uncertainty.camera_sigma[0] = 5.06e-3;  // a thousandth
  const BudgetShare share_of_length = share(uncertainty, VisionItem::kFocalLength);
  EXPECT_GT(std::hypot(share_of_length.across_mm, share_of_length.along_mm), 0.03);
  EXPECT_LT(std::hypot(share_of_length.across_mm, share_of_length.along_mm), 0.4);
}

TEST_F(VisionBudgetTest, NoiseOfThePictureCountsAsManyTimesAsItIsLarge) {
  VisionAssumptions assumptions;
  const double once = share({}, VisionItem::kPicture, assumptions).across_mm;
  assumptions.center_px *= 2.0;
  EXPECT_NEAR(share({}, VisionItem::kPicture, assumptions).across_mm, 2.0 * once, 1e-12);
  EXPECT_GT(once, 0.0005);
  EXPECT_LT(once, 0.05);
}

TEST_F(VisionBudgetTest, AnEflTooLongMakesUpForATipTooFar) {
  // Of a camera square to the sheet: an EFL too long puts the sheet farther away, a tip too far
  // from the camera nearer to it. One docking has both wrong alike.
  core::ToolSettings tool;
  tool.position_mm = {0.0, 30.0, 113.0};
  model_ = *core::pose::make_pose_model(tests::source_camera(), tool, *sheet_);
  VisionAssumptions exact;
  exact.center_px = 0.0;
  exact.tube_place_mm = 0.0;
  core::pose::CalibrationUncertainty uncertainty;
  uncertainty.camera_sigma[0] = 5.06e-3;
  const double alone = share(uncertainty, VisionItem::kFocalLength, exact).along_mm;
  uncertainty.tool_sigma[2] = alone;
  EXPECT_NEAR(share(uncertainty, VisionItem::kTogether, exact).along_mm, std::sqrt(2.0) * alone,
              0.01 * alone);

  uncertainty.focal_length_correlation[2] = 1.0;
  EXPECT_LT(share(uncertainty, VisionItem::kTogether, exact).along_mm, 0.02 * alone);
  uncertainty.focal_length_correlation[2] = -1.0;
  EXPECT_NEAR(share(uncertainty, VisionItem::kTogether, exact).along_mm, 2.0 * alone, 0.02 * alone);
}

TEST_F(VisionBudgetTest, TipAndAxisCountWithTheirCorrelation) {
  // alpha turns about the camera's z, so it moves nothing of an axis along it; beta leans it along
  // the camera's x: at 50 mm by 50 beta, which a tip off the other way takes back.
  core::ToolSettings tool;
  tool.position_mm = {0.0, 30.0, 113.0};
  model_ = *core::pose::make_pose_model(tests::source_camera(), tool, *sheet_);
  VisionAssumptions exact;
  exact.center_px = 0.0;
  exact.tube_place_mm = 0.0;
  exact.height_mm = 50.0;
  core::pose::CalibrationUncertainty uncertainty;
  uncertainty.tool_sigma[4] = 0.1;
  uncertainty.tool_sigma[0] = 50.0 * 0.1 * std::numbers::pi / 180.0;
  uncertainty.tool_correlation(0, 4) = uncertainty.tool_correlation(4, 0) = -1.0;
  EXPECT_LT(share(uncertainty, VisionItem::kTogether, exact).across_mm, 1e-6);
  uncertainty.tool_correlation(0, 4) = uncertainty.tool_correlation(4, 0) = 1.0;
  EXPECT_NEAR(share(uncertainty, VisionItem::kTogether, exact).across_mm,
              2.0 * uncertainty.tool_sigma[0], 1e-6);
}

TEST_F(VisionBudgetTest, RefusesATooEmptyPicture) {
  sheet_->rows = {0, 0};
  sheet_->columns = {0, 2};
  EXPECT_EQ(vision_budget(model_, *sheet_, {}, {}).error(), core::Error::kIllConditioned);
}

}  // namespace
}  // namespace tubesight::board
