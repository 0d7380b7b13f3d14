#include "core/calibration/tool_calibration.h"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace tubesight::core::calibration {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Eigen::Matrix3d turned(double alpha_deg, double beta_deg, double gamma_deg) {
  return (Eigen::AngleAxisd(alpha_deg * kDegree, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(beta_deg * kDegree, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(gamma_deg * kDegree, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// A tool as mounted, and the camera's place when it is docked so.
const Transform<frames::Camera, frames::Tool> kTool{turned(-0.06, -0.8, 48.0), {-3.0, 31.6, 112.8}};

Docking docked_at(double x_mm, double y_mm, double heading_deg, double height_mm) {
  Docking docking;
  const Transform<frames::Sheet, frames::Tool> T_sheet_tool{turned(heading_deg, 0.0, 0.0),
                                                            {x_mm, y_mm, -height_mm}};
  docking.T_sheet_camera = T_sheet_tool * kTool.inverse();
  docking.tip_mm << x_mm, y_mm;
  return docking;
}

/// What a picture tells of the camera: a micrometre and 0.6 thousandths of a degree.
const math::Matrix6d kGood =
    (math::Vector6d() << 1e-6, 1e-6, 1e-6, 1e-10, 1e-10, 1e-10).finished().asDiagonal();

TEST(ToolCalibration, OfOneDockingIsTheToolAsMounted) {
  DockingList dockings;
  ASSERT_TRUE(dockings.try_push_back(docked_at(762.0, 508.0, 25.0, 3.0)));

  const ToolCalibration result = calibrate_tool(dockings, {3.0, 25.0 * kDegree, 0.0});

  EXPECT_LT((result.T_camera_tool.translation_mm() - kTool.translation_mm()).norm(), 1e-9);
  EXPECT_LT((result.T_camera_tool.rotation() - kTool.rotation()).norm(), 1e-12);
  EXPECT_NEAR(result.values(3), -0.06, 1e-9);
  EXPECT_NEAR(result.values(4), -0.8, 1e-9);
  EXPECT_NEAR(result.values(5), 48.0, 1e-9);
}

TEST(ToolCalibration, OfSeveralHeadingsIsTipAndAxisOfAll) {
  DockingList dockings;
  for (const double heading : {0.0, 80.0, 170.0, -60.0}) {
    ASSERT_TRUE(dockings.try_push_back(docked_at(25.4 * heading, 50.8, heading, 0.0)));
    dockings[dockings.size() - 1].covariance = kGood;
  }

  const ToolCalibration result = calibrate_tool(dockings, {0.0, 0.0, 0.15});

  EXPECT_LT((result.T_camera_tool.translation_mm() - kTool.translation_mm()).norm(), 1e-9);
  EXPECT_LT((result.T_camera_tool.rotation() - kTool.rotation()).norm(), 1e-9);
  EXPECT_LT(result.tip_spread_mm, 1e-9);
  EXPECT_LT(result.axis_spread_rad, 1e-9);
}

TEST(ToolCalibration, SaysHowFarDockingsAreApart) {
  DockingList dockings;
  ASSERT_TRUE(dockings.try_push_back(docked_at(0.0, 0.0, 0.0, 0.0)));
  ASSERT_TRUE(dockings.try_push_back(docked_at(25.4, 0.0, 0.0, 0.0)));
  dockings[0].covariance = kGood;
  dockings[1].covariance = kGood;
  dockings[1].tip_mm.x() += 25.4;  // the tube beside it named

  EXPECT_NEAR(calibrate_tool(dockings, {}).tip_spread_mm, 12.7, 1e-4);
}

TEST(ToolCalibration, PromisesTheErrorThatItHas) {
  math::Matrix6d root = math::Matrix6d::Zero();
  root.diagonal() << 0.003, 0.005, 0.003, 2e-5, 3e-5, 2e-5;
  root(0, 4) = 0.002;
  std::mt19937 random(5);
  std::normal_distribution<double> spread(0.0, 1.0);
  const Docking exact = docked_at(762.0, 508.0, 0.0, 0.0);
  constexpr int kDraws = 400;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    math::Vector6d error;
    for (int i = 0; i < 6; ++i) {
      error(i) = spread(random);
    }
    error = root * error;
    Docking docking = exact;
    const Eigen::Vector3d turn = error.tail<3>();
    docking.T_sheet_camera = {Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() *
                                  exact.T_sheet_camera.rotation(),
                              exact.T_sheet_camera.translation_mm() + error.head<3>()};
    docking.covariance = root * root.transpose();
    DockingList dockings;
    ASSERT_TRUE(dockings.try_push_back(docking));
    const ToolCalibration result = calibrate_tool(dockings, {0.0, 0.0, 0.0});
    math::Vector6d off;
    off << -3.0, 31.6, 112.8, -0.06, -0.8, 48.0;
    off = result.values - off;
    math::Cholesky<6> factor;
    ASSERT_TRUE(factor.factor(result.covariance));
    sum += off.dot(factor.solve(off)) / 6.0;
  }
  EXPECT_NEAR(sum / kDraws, 1.0, 0.12);
}

TEST(ToolCalibration, HeadingsTellAnOffsetThatAllDockingsHave) {
  const Eigen::Vector2d offset(0.10, -0.06);
  DockingList dockings;
  for (int i = 0; i < 12; ++i) {
    ASSERT_TRUE(dockings.try_push_back(docked_at(762.0, 508.0, 15.0 * i, 0.0)));
    dockings[i].tip_mm -= offset;
  }

  const ToolCalibration result = calibrate_tool(dockings, {0.0, 0.0, 0.15});

  EXPECT_LT((result.offset_mm - offset).norm(), 0.3 * offset.norm());
  EXPECT_LT(result.offset_sigma_mm.maxCoeff(), 0.06);
  EXPECT_LT((result.T_camera_tool.translation_mm() - kTool.translation_mm()).norm(), 0.04);
}

TEST(ToolCalibration, PromisesTheErrorOfSeveralDockingsWithClearance) {
  std::mt19937 random(11);
  std::normal_distribution<double> spread(0.0, 0.15 / std::numbers::sqrt2);
  constexpr int kDraws = 400;
  double tip = 0.0;
  double offset = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::Vector2d shared(spread(random), spread(random));
    DockingList dockings;
    for (const double heading : {0.0, 70.0, 160.0}) {
      Docking docking = docked_at(762.0, 508.0, heading, 0.0);
      docking.tip_mm -= shared + Eigen::Vector2d(spread(random), spread(random));
      docking.covariance = kGood;
      ASSERT_TRUE(dockings.try_push_back(docking));
    }
    const ToolCalibration result = calibrate_tool(dockings, {0.0, 0.0, 0.15});
    const Eigen::Vector3d off = result.T_camera_tool.translation_mm() - kTool.translation_mm();
    math::Cholesky<3> factor;
    ASSERT_TRUE(factor.factor(result.covariance.topLeftCorner<3, 3>()));
    tip += factor.forward(off).squaredNorm() / 3.0;
    offset += (result.offset_mm - shared).cwiseQuotient(result.offset_sigma_mm).squaredNorm() / 2.0;
  }
  EXPECT_NEAR(tip / kDraws, 0.67, 0.1) << "along the tube nothing was drawn";
  EXPECT_NEAR(offset / kDraws, 1.0, 0.15);
}

TEST(ToolCalibration, AddsTheClearanceAcrossTheTube) {
  DockingList dockings;
  ASSERT_TRUE(dockings.try_push_back(docked_at(0.0, 0.0, 0.0, 0.0)));

  const ToolCalibration result = calibrate_tool(dockings, {0.0, 0.0, 0.15});

  const Eigen::Matrix3d covariance = result.covariance.topLeftCorner<3, 3>();
  const Eigen::Vector3d axis = kTool.rotation().col(2);
  const Eigen::Vector3d across = kTool.rotation().col(0);
  EXPECT_NEAR(axis.dot(covariance * axis), 0.0, 1e-12);
  EXPECT_NEAR(across.dot(covariance * across), 0.0225, 1e-9);
}

}  // namespace
}  // namespace tubesight::core::calibration
