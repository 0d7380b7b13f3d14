#include "board/bench/output/pose_rows.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using core::math::Matrix6d;
using core::pose::PoseEstimate;

/// Under tube (20, 30): turned by 90 degrees about z, which moves the tool's x axis to y.
PoseEstimate estimate() {
  PoseEstimate pose;
  Eigen::Matrix3d turned;
  turned << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  pose.T_sheet_tool = {turned, Eigen::Vector3d(762.05004, -0.00004, -12.5)};
  pose.T_camera_sheet = {Eigen::Matrix3d::Identity(), Eigen::Vector3d(1.0, 2.0, 300.0)};
  pose.rms_px = 0.0384;
  pose.tubes = 65;
  pose.nearest = {20, 30};
  pose.offset_mm = 0.25;
  return pose;
}

Matrix6d covariance() {
  Matrix6d c = Matrix6d::Zero();
  c.diagonal() << 4e-6, 9e-6, 16e-6, 1e-8, 4e-8, 9e-8;
  c(0, 1) = c(1, 0) = 1e-6;
  return c;
}

TEST(PoseRows, HaveTheColumnsOfTheHeaderWithFixedDecimals) {
  const PoseEstimate pose = estimate();
  std::string out;

  append_pose_row(out, {"a.png", &pose, covariance(), true, true});

  // One standard deviation of the rotation vector's z, 3e-4 rad, is alpha's: 0.01719 degrees; with
  // alpha at 90 degrees, beta turns about -x (1e-4 rad) and gamma about y (2e-4 rad).
  EXPECT_EQ(out,
            "a.png,762.0500,0.0000,-12.5000,90.00000,0.00000,0.00000,1.0000,2.0000,300.0000,"
            "0.00000,0.00000,0.00000,0.0020,0.0030,0.0040,0.038,65,20,30,0.2500,0.01719,0.00573,"
            "0.01146\n");
  EXPECT_EQ(std::count(out.begin(), out.end(), ','),
            std::count(kPoseHeader.begin(), kPoseHeader.end(), ','));
}

TEST(PoseRows, LeaveCellsEmptyThatAreNotKnown) {
  const PoseEstimate pose = estimate();
  std::string without_tool;
  std::string without_tube;
  std::string refused;

  append_pose_row(without_tool, {"a.png", &pose, covariance(), false, true});
  append_pose_row(without_tube, {"a.png", &pose, covariance(), true, false});
  append_pose_row(refused, {"a.png", nullptr, covariance(), true, true});

  EXPECT_EQ(without_tool,
            "a.png,,,,,,,1.0000,2.0000,300.0000,0.00000,0.00000,0.00000,,,,0.038,65,,,,,,\n");
  EXPECT_NE(without_tube.find(",0.038,65,,,,0.01719,"), std::string::npos) << without_tube;
  EXPECT_EQ(refused, "a.png,,,,,,,,,,,,,,,,,,,,,,,\n");
}

TEST(PoseRows, QuoteNamesThatHoldACommaOrAQuotationMark) {
  std::string out;

  append_pose_row(out, {"a,\"b\".png", nullptr, covariance(), true, true});

  EXPECT_EQ(out.find("\"a,\"\"b\"\".png\","), 0U) << out;
}

TEST(CovarianceRows, HoldTheUpperTriangleInTheHeadersOrder) {
  const PoseEstimate pose = estimate();
  std::string out;

  append_covariance_row(out, {"a.png", &pose, covariance(), true, true});

  EXPECT_EQ(out.find("a.png,4.000000000e-06,1.000000000e-06,0.000000000e+00,"), 0U) << out;
  EXPECT_NE(out.find(",9.000000000e-08\n"), std::string::npos);
  EXPECT_EQ(std::count(out.begin(), out.end(), ','), 21);
  EXPECT_EQ(std::count(kCovarianceHeader.begin(), kCovarianceHeader.end(), ','), 21);
}

}  // namespace
}  // namespace tubesight::board
