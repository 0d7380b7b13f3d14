#include "drivers/settings/session_checks.h"

#include <memory>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

class SessionChecks : public testing::Test {
 protected:
  SessionChecks() {
    sheet_.row_step_mm = {0.0, 25.4};
    sheet_.column_step_mm = {25.4, 0.0};
    sheet_.bore_mm = 18.6;
    sheet_.rows = {0, 120};
    sheet_.columns = {0, 120};
  }

  void click(std::int32_t row, std::int32_t column, double u, double v) {
    ASSERT_TRUE(start_.tubes.try_push_back({{row, column}, {u, v}}));
  }

  std::unique_ptr<core::TubesheetSettings> owned_ = std::make_unique<core::TubesheetSettings>();
  core::TubesheetSettings& sheet_ = *owned_;
  core::StartSettings start_;
};

TEST_F(SessionChecks, LatticeNeedsTwoDirections) {
  EXPECT_EQ(why_no_lattice(sheet_), "");
  sheet_.column_step_mm = {0.5, 25.4};
  EXPECT_EQ(why_no_lattice(sheet_),
            "the steps lie in one line, expected row_step_mm and column_step_mm at least 6 degrees "
            "apart");
  sheet_.column_step_mm = {0.0, 0.0};
  EXPECT_EQ(why_no_lattice(sheet_),
            "a step below 1 mm, expected row_step_mm and column_step_mm from tube to tube");
}

TEST_F(SessionChecks, TubesMayNotOverlap) {
  EXPECT_EQ(why_bore_too_wide(sheet_), "");
  sheet_.bore_mm = 25.4;
  EXPECT_EQ(why_bore_too_wide(sheet_),
            "25.4, expected less than the 25.4 mm between neighbouring tubes");
}

TEST_F(SessionChecks, TubesOfShiftedRowsMayNotOverlap) {
  // Rows 12 mm apart: half a step off, neighbours are sqrt(12.7^2 + 12^2) = 17.47 mm apart; a
  // quarter off, sqrt(6.35^2 + 12^2) = 13.58 mm.
  sheet_.row_step_mm = {0.0, 12.0};
  sheet_.bore_mm = 15.0;
  EXPECT_NE(why_bore_too_wide(sheet_), "");
  sheet_.odd_row_shift = 0.5;
  EXPECT_EQ(why_bore_too_wide(sheet_), "");
  sheet_.odd_row_shift = -0.25;
  EXPECT_EQ(why_bore_too_wide(sheet_),
            "15, expected less than the 13.58 mm between neighbouring tubes");
}

TEST_F(SessionChecks, ShiftsWrittenAsMissingAddressesAreToldABetterWay) {
  sheet_.column_step_mm = {6.35, 0.0};
  ASSERT_TRUE(sheet_.missing.try_push_back({0, 1}));
  EXPECT_EQ(why_bore_too_wide(sheet_),
            "18.6, expected less than the 6.35 mm between neighbouring tubes, missing ones "
            "included (a sheet of shifted rows has an odd_row_shift)");
}

TEST_F(SessionChecks, SheetMayNotReachTooFar) {
  EXPECT_EQ(why_sheet_too_large(sheet_), "");
  sheet_.rows = {-2000, 120};
  EXPECT_EQ(why_sheet_too_large(sheet_),
            "tube (-2000, 0) would stand at (0, -5.08e+04) mm, expected within 30000 mm of the "
            "origin");
}

TEST_F(SessionChecks, SheetMayNotReachTooFarByItsShiftedRows) {
  // Column 1181 stands at 29997.4 mm, in odd rows 6.35 mm further: rows 0 and 2 are within.
  sheet_.columns = {0, 1181};
  sheet_.rows = {0, 2};
  EXPECT_EQ(why_sheet_too_large(sheet_), "");
  sheet_.odd_row_shift = 0.25;
  EXPECT_NE(why_sheet_too_large(sheet_), "");
  sheet_.rows = {0, 0};
  EXPECT_EQ(why_sheet_too_large(sheet_), "");
}

TEST_F(SessionChecks, ClicksAreJudgedByWhereShiftedTubesStand) {
  // Tubes of one column: with the shift they make a flat triangle, without it a line.
  click(40, 60, 300, 200);
  click(41, 60, 325, 300);
  click(42, 60, 300, 400);
  EXPECT_EQ(why_clicks_contradict(start_, &sheet_),
            "the tubes lie in one line on the sheet, expected a triangle");
  sheet_.odd_row_shift = 0.25;
  EXPECT_EQ(why_clicks_contradict(start_, &sheet_), "");
  sheet_.odd_row_shift = -0.25;
  EXPECT_NE(why_clicks_contradict(start_, &sheet_), "");
}

TEST_F(SessionChecks, DistortionMayNotFoldThePicture) {
  core::CameraSettings camera;
  camera.width_px = 101;
  camera.height_px = 101;
  camera.cell_width_mm = 0.01;
  camera.cell_height_mm = 0.01;
  camera.sensor_columns = 101;
  camera.frame_columns = 101;
  camera.center_px = {50.0, 50.0};
  // The corner is at r^2 = 0.5 mm^2: 1 + 3 k r^2 vanishes at k = -2/3.
  camera.distortion_per_mm2 = -0.66;
  EXPECT_EQ(why_picture_folds(camera), "");
  camera.distortion_per_mm2 = -0.67;
  EXPECT_EQ(why_picture_folds(camera),
            "-0.67 folds the picture over, expected 1 + 3 k r^2 + 5 k2 r^4 above 0 up to the "
            "farthest corner, r = 0.7071 mm");
  // k2 may mend it at the corner, 1 - 0.975 * ... stays above 0 between as well.
  camera.distortion2_per_mm4 = 1.0;
  EXPECT_EQ(why_picture_folds(camera), "");
  // Or spoil it within: least at s = -0.3 k / k2 = 0.1, where 1 + 0.1 (-30 + 15) < 0.
  camera.distortion_per_mm2 = -10.0;
  camera.distortion2_per_mm4 = 30.0;
  EXPECT_NE(why_picture_folds(camera), "");
}

TEST_F(SessionChecks, ClickedTubesMustExist) {
  sheet_.addresses = core::AddressParity::kEvenSum;
  ASSERT_TRUE(sheet_.missing.try_push_back({2, 4}));

  EXPECT_EQ(why_no_tube(sheet_, {2, 2}), "");
  EXPECT_EQ(why_no_tube(sheet_, {2, 3}),
            "tube (2, 3) does not exist, expected an even sum of row and column");
  EXPECT_EQ(why_no_tube(sheet_, {2, 4}),
            "tube (2, 4) is listed as missing, expected a tube that stands");
  EXPECT_EQ(why_no_tube(sheet_, {-1, 1}),
            "tube (-1, 1) is outside the tubesheet, expected a row from 0 to 120 and a column from "
            "0 to 120");
}

TEST_F(SessionChecks, ClicksMustAgreeWithTheSheet) {
  // Row step along y, column step along x: in the picture rows grow downwards, columns rightwards.
  click(40, 60, 300, 200);
  click(41, 60, 300, 260);
  click(40, 61, 360, 200);
  EXPECT_EQ(why_clicks_contradict(start_, &sheet_), "");

  // Numbering mirrored: the column step points the other way.
  sheet_.column_step_mm = {-25.4, 0.0};
  EXPECT_EQ(why_clicks_contradict(start_, &sheet_),
            "the clicks go round the other way than their addresses, expected the order of "
            "row_step_mm and column_step_mm (rows and columns swapped, or a step's sign?)");
  EXPECT_EQ(why_clicks_contradict(start_, nullptr), "");
}

TEST_F(SessionChecks, ClicksMustSpanATriangle) {
  click(40, 60, 300, 200);
  click(41, 60, 360, 201);
  click(40, 61, 420, 200);
  EXPECT_EQ(why_clicks_contradict(start_, &sheet_),
            "the clicks lie in one line in the picture, expected a triangle");

  start_.tubes.clear();
  click(40, 60, 300, 200);
  click(40, 61, 360, 200);
  click(40, 62, 320, 260);
  EXPECT_EQ(why_clicks_contradict(start_, &sheet_),
            "the tubes lie in one line on the sheet, expected a triangle");

  start_.tubes.clear();
  click(40, 60, 300, 200);
  click(40, 60, 360, 200);
  click(40, 62, 320, 260);
  EXPECT_EQ(why_clicks_contradict(start_, &sheet_),
            "tube (40, 60) is named twice, expected different tubes");
}

TEST_F(SessionChecks, FieldsMustComeOftenEnoughForMotionAndPitch) {
  // 3000 mm/s^2 for 1/15 s: 13.3 mm of the 10.16 less 0.3 that are allowed.
  EXPECT_EQ(why_fields_too_seldom({300.0, 3000.0}, sheet_, 1.0 / 15.0),
            "15 fields a second are too few: from one to the next the tool can be 13.33 mm off its "
            "course, expected at most 9.86 mm with 25.4 mm between neighbouring tubes, as by "
            "max_acceleration_mm_s2 = 1900 or max_speed_mm_s = 66 or 19 fields a second");
  EXPECT_EQ(why_fields_too_seldom({300.0, 1900.0}, sheet_, 1.0 / 15.0), "");
  EXPECT_EQ(why_fields_too_seldom({66.0, 3000.0}, sheet_, 1.0 / 15.0), "");
  EXPECT_EQ(why_fields_too_seldom({300.0, 3000.0}, sheet_, 1.0 / 19.0), "");
  EXPECT_EQ(why_fields_too_seldom({1.0, 1.0}, sheet_, 1.25),
            "0.8 fields a second are too few: from one to the next the tool can be 1.562 mm off "
            "its course, expected at most 9.86 mm with 25.4 mm between neighbouring tubes, as by "
            "1.2 fields a second");
}

TEST_F(SessionChecks, FindsATubeInBothLists) {
  ASSERT_TRUE(sheet_.missing.try_push_back({9, 9}));
  ASSERT_TRUE(sheet_.missing.try_push_back({3, 4}));
  ASSERT_TRUE(sheet_.plugged.try_push_back({4, 3}));
  EXPECT_FALSE(listed_twice(sheet_).has_value());
  ASSERT_TRUE(sheet_.plugged.try_push_back({3, 4}));
  EXPECT_EQ(listed_twice(sheet_), (core::TubeAddress{3, 4}));
}

}  // namespace
}  // namespace tubesight::drivers
