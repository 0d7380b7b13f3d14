#include "core/calibration/stage_lean.h"

#include <cmath>

#include <Eigen/LU>

namespace tubesight::core::calibration {
namespace {

/// Of a template square to the camera, where nothing tells axis and centre apart.
math::Matrix6d all_in_the_center(const Sensor& sensor, const CameraValues& camera) {
  math::Vector6d change = math::Vector6d::Zero();
  change(2) = kStageLean_rad * camera(0) * camera(1) / sensor.column_mm;
  change(3) = kStageLean_rad * camera(0) / sensor.row_mm;
  return change.cwiseAbs2().asDiagonal();
}

/// What makes an axis lean is a stage that does, or a template that was moved aside between the
/// heights. The latter came nearer by all of the height read, not by its cosine, and EFL is as much
/// longer.
math::Matrix6d moved_aside(const CameraValues& camera, double cosine) {
  math::Matrix6d doubt = math::Matrix6d::Zero();
  doubt(0, 0) = std::pow(camera(0) * (1.0 - cosine), 2);
  return doubt;
}

// No stage leans by more, ten times what is expected of one: then the template moved, and the dots
// are left where no stage explains them.
constexpr double kMostLean_rad = 10.0 * kStageLean_rad;

}  // namespace

math::Matrix6d settle_stage_axis(CalibrationData& data, CalibrationState& state,
                                 FitScratch& scratch, CalibrationOutcome& outcome) {
  const CalibrationState held = state;
  FitOptions options = outcome.freed;
  options.stage_axis = true;
  const FitOutcome fit = fit_camera(options, data, state, scratch);
  const Eigen::Matrix2d known = fit.axis_covariance;
  const bool good = fit.converged && fit.determined && known.determinant() > 0.0;
  const double falls = (outcome.fit.sum_px2 - fit.sum_px2) / (fit.sigma_px * fit.sigma_px);
  constexpr double kVariance = kStageLean_rad * kStageLean_rad;
  // How much better the views are explained by a stage that stands square than by one that leans
  // somehow: few places of what it might lean are as near to 0 as the views say, or they say
  // otherwise.
  const double for_square =
      good ? std::sqrt((Eigen::Matrix2d::Identity() + kVariance * known.inverse()).determinant()) *
                 std::exp(-0.5 * falls)
           : 1.0;
  constexpr double kLeastFall = 9.0;  // by chance in one of a hundred
  const double cosine = state.stage_axis.dot(state.stage.R_camera_target.col(2));
  if (good && for_square < 1.0 && falls > kLeastFall && cosine > std::cos(kMostLean_rad)) {
    outcome.fit = fit;
    outcome.freed = options;
    return moved_aside(state.camera, cosine);
  }
  state = held;
  outcome.fit = fit_camera(outcome.freed, data, state, scratch);  // the residuals again
  if (!good) {
    return all_in_the_center(data.sensor, state.camera);
  }
  // What a lean changes of the camera is their covariance by the lean's.
  const Eigen::Matrix<double, 6, 2> slope = fit.camera_axis_covariance * known.inverse();
  const Eigen::Matrix2d left =
      (known.inverse() + Eigen::Matrix2d::Identity() / kVariance).inverse();
  const double doubt = std::fmin(1.0, 2.0 / (1.0 + for_square));
  return doubt * slope * left * slope.transpose();
}

}  // namespace tubesight::core::calibration
