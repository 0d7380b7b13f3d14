#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/calibration/camera_calibration.h"

namespace tubesight::core::calibration {

inline Eigen::Matrix3d turned(double about_x_deg, double about_y_deg, double about_z_deg) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  return (Eigen::AngleAxisd(about_x_deg * kDegree, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(about_y_deg * kDegree, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(about_z_deg * kDegree, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

/// A known camera and what it sees of a template, computed, with noise.
class ComputedViews : public ::testing::Test {
 protected:
  ComputedViews() {
    data_->sensor = {0.0084 * 768 / 635, 0.0098, 635.0, 480.0};
    data_->dot_radius_mm = 2.0;
    truth_ << 5.06, 1.021, 324.3, 233.8, 0.0092, 0.0;
  }

  /// Ten lines of ten dots, 8 mm apart, about the middle of the template.
  void add_view(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& middle, bool staged = false,
                double height_mm = 0.0) {
    CalibrationView view;
    view.first = data_->dots.size();
    view.staged = staged;
    view.height_mm = height_mm;
    for (int i = 0; i < 100; ++i) {
      SeenDot dot;
      dot.place_mm << 8.0 * (i % 10), 8.0 * (i / 10), 0.0;
      TargetPose pose;
      pose.R_camera_target = rotation;
      pose.t_camera_target = middle - rotation * Eigen::Vector3d(36.0, 36.0, 0.0);
      dot.seen_px =
          centroid_of(data_->sensor, truth_, pose, printed_(stretch_.cwiseProduct(dot.place_mm)),
                      data_->dot_radius_mm, tangential_) +
          noise_px_ * Eigen::Vector2d(spread_(random_), spread_(random_));
      ASSERT_TRUE(data_->dots.try_push_back(dot));
    }
    view.count = 100;
    ASSERT_TRUE(data_->views.try_push_back(view));
  }

  /// Two heights of a stage whose axis is the template's normal, tipped by `tip`.
  void add_stage(double tip = 0.0, double from_mm = 0.0, double to_mm = 30.0) {
    const Eigen::Matrix3d rotation = turned(0.2, -0.2, turn_deg_);
    const Eigen::Vector3d axis = (rotation.col(2) + Eigen::Vector3d(tip, 0.0, 0.0)).normalized();
    const Eigen::Vector3d middle(0.5, -0.3, 82.0);
    add_view(rotation, middle, true, from_mm);
    add_view(rotation, middle + 30.0 * axis, true, to_mm);
  }

  void add_free_poses() {
    add_view(turned(25.0, 0.0, 3.0), {0.0, 2.0, 95.0});
    add_view(turned(-25.0, 5.0, 80.0), {3.0, 0.0, 100.0});
    add_view(turned(0.0, 30.0, 40.0), {-2.0, 1.0, 105.0});
    add_view(turned(5.0, -30.0, -20.0), {0.0, -3.0, 98.0});
  }

  CalibrationRefusal calibrate() {
    outcome_ = calibrate_camera(*data_, *state_, *scratch_);
    return outcome_.refusal;
  }

  /// Each parameter within 4.5 of the standard deviations told.
  void expect_true() {
    for (int i = 0; i < 6; ++i) {
      const double sigma = std::sqrt(outcome_.fit.camera_covariance(i, i));
      EXPECT_LT(std::abs(state_->camera(i) - truth_(i)), 4.5 * sigma + 1e-9) << i;
    }
  }

  /// Where a dot of the template really is.
  Eigen::Vector3d (*printed_)(const Eigen::Vector3d& place_mm) = [](const Eigen::Vector3d& place) {
    return place;
  };
  CameraValues truth_;
  TangentialValues tangential_{0.0, 0.0};
  double noise_px_ = 0.015;
  double turn_deg_ = 0.7;                              ///< of the template on the stage
  Eigen::Vector3d stretch_ = Eigen::Vector3d::Ones();  ///< of the template, untold
  std::mt19937 random_{7};
  std::normal_distribution<double> spread_{0.0, 1.0};
  std::unique_ptr<CalibrationData> data_ = std::make_unique<CalibrationData>();
  std::unique_ptr<CalibrationState> state_ = std::make_unique<CalibrationState>();
  std::unique_ptr<FitScratch> scratch_ = std::make_unique<FitScratch>();
  CalibrationOutcome outcome_;
};

}  // namespace tubesight::core::calibration
