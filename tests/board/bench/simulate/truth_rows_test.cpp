#include "board/bench/simulate/truth_rows.h"

#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "core/base/transform.h"

namespace tubesight::board {
namespace {

TEST(TruthRow, HasTheColumnsOfTheRecordings) {
  EXPECT_TRUE(kTruthHeader.starts_with(
      "t,frame,field,tool_x,tool_y,tool_z,tool_alpha,tool_beta,tool_gamma,speed,cs_x,cs_y,cs_z,"
      "cs_alpha,cs_beta,cs_gamma,cs_00,cs_01,cs_02,cs_03,cs_10,cs_11,cs_12,cs_13,cs_20,cs_21,"
      "cs_22,cs_23,axis_x,axis_y,near_row,near_col,near_state,offset_mm,off_x,off_y,aligned"));
  EXPECT_EQ(kTrueCentersHeader,
            "frame,field,t,row,col,state,x_f,y_f,ell_x,ell_y,half_w,half_h,rim_in_frame,occluded,"
            "bore_mm,X,Y");
}

drivers::SimulatedField a_field() {
  drivers::SimulatedField field;
  field.field.mid_exposure = core::FieldTime(16'666'667);
  field.field.lamp_permille = 700;
  field.truth.T_sheet_tool = {core::rotation_from_degrees({90.0, 0.0, 0.0}),
                              Eigen::Vector3d(10.0, 20.0, -60.0)};
  field.truth.T_camera_sheet = {core::rotation_from_degrees({0.0, 0.0, 90.0}),
                                Eigen::Vector3d(1.0, 2.0, 100.0)};
  field.truth.speed_mm_s = 12.5;
  field.truth.axis_known = true;
  field.truth.axis.axis_mm = {10.5, 20.25};
  field.truth.axis.nearest = {{4, -3}, core::rendering::TubeEndKind::kPlugRolled, {0.3, -0.4}, 0.5};
  field.faults.kinds = (1U << static_cast<unsigned>(drivers::FaultKind::kTorn)) |
                       (1U << static_cast<unsigned>(drivers::FaultKind::kEmi));
  return field;
}

TEST(TruthRow, TellsPoseInRadiansAndTheSheetFromTheSensor) {
  std::string row;
  core::CameraSettings camera;
  camera.focal_length_mm = 5.06;

  append_truth_row(row, {7, 1}, a_field(), camera, 2.5);

  EXPECT_EQ(row,
            "0.016667,7,1,10.00000,20.00000,-60.00000,1.57079633,0.00000000,0.00000000,12.50,"
            "1.00000,2.00000,105.06000,0.00000000,0.00000000,1.57079633,"
            "1.00000000,0.00000000,0.00000000,1.00000000,"
            "0.00000000,0.00000000,-1.00000000,2.00000000,"
            "0.00000000,1.00000000,0.00000000,105.06000000,"
            "10.50000,20.25000,4,-3,plug_rolled,0.5000,0.3000,-0.4000,1,700,torn+emi,0\n");
}

TEST(TruthRow, NothingIsAlignedUnderAVoidOrBeyondTheGate) {
  const auto ends = [](const drivers::SimulatedField& field) {
    std::string row;
    append_truth_row(row, {0, 0}, field, {}, 0.4);
    return row.substr(row.find("-0.4000,") + 8, 1);
  };
  drivers::SimulatedField field = a_field();

  EXPECT_EQ(ends(field), "0") << "0.5 mm off, gate 0.4 mm";
  field.truth.axis.nearest.offset_mm = 0.3;
  EXPECT_EQ(ends(field), "1");
  field.truth.axis.nearest.kind = core::rendering::TubeEndKind::kVoid;
  EXPECT_EQ(ends(field), "0");
}

TEST(TruthRow, IsUndetectableWhileASilentJumpIsAtWork) {
  const auto ends = [](const drivers::SimulatedField& field) {
    std::string row;
    append_truth_row(row, {0, 0}, field, {}, 2.5);
    return row.substr(row.rfind(','));
  };
  drivers::SimulatedField field = a_field();
  field.faults.kinds = 1U << static_cast<unsigned>(drivers::FaultKind::kJump);

  EXPECT_EQ(ends(field), ",0\n") << "it was told, or there was a start since";
  field.truth.slip = {0, -1};
  EXPECT_EQ(ends(field), ",1\n");
}

TEST(TrueCenterRows, TellTheTubesWhoseCentreIsInThePicture) {
  core::CameraSettings camera;
  camera.width_px = 635;
  camera.height_px = 480;
  drivers::TubeInView inside;
  inside.address = {4, -3};
  inside.end = {core::rendering::TubeEndKind::kOpen, {101.5, 202.25, 0.0}, 9.3};
  inside.image = {{96.97, 46.26}, {97.1, 44.8}, {36.3, 34.1}, 1.0, 0.25};
  drivers::TubeInView outside = inside;
  outside.image.center_px = {635.0, 46.0};
  std::string rows;

  append_true_center_rows(rows, {10, 0}, a_field(), camera, {inside, outside});

  EXPECT_EQ(rows,
            "10,0,0.016667,4,-3,open,96.970,46.260,97.100,44.800,36.30,34.10,1.00,0.25,18.6000,"
            "101.5000,202.2500\n");
}

}  // namespace
}  // namespace tubesight::board
