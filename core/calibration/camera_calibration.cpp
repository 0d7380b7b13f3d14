#include "core/calibration/camera_calibration.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/stage_lean.h"
#include "core/calibration/tsai_start.h"

namespace tubesight::core::calibration {
namespace {

// One standard deviation of the map, its RMS over the picture.
constexpr double kForBase_px = 0.05;
constexpr double kForPose_px = 0.15;
constexpr double kForTracking_px = 1.0;
// Beyond this share EFL is not known at all: the fit ran along a valley.
constexpr double kMostOfFocal = 0.02;

// A camera of this model shows dots nearer than this; worn photographs of paper leave half of it.
constexpr double kMostRms_px = 1.0;
// Dots beyond so many standard deviations are left out; one in five million is by chance.
constexpr double kOutlier = 6.0;
constexpr double kMostLeftOut = 0.1;  // of the dots

// The sum of squares falls by about sigma^2 for an unknown that means nothing. By 25 times that:
// five standard deviations.
constexpr double kAsksForIt = 25.0;

CalibrationRefusal check_views(const CalibrationData& data) {
  std::int32_t staged = 0;
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  for (const CalibrationView& view : data.views) {
    if (view.staged) {
      ++staged;
      least = std::min(least, view.height_mm);
      most = std::max(most, view.height_mm);
    }
  }
  if (data.views.size() < 2) {
    return CalibrationRefusal::kOneView;
  }
  // A stage with one view beside free poses is a free pose of its own.
  return staged > 1 && !(most > least) ? CalibrationRefusal::kEqualHeights
                                       : CalibrationRefusal::kNone;
}

/// Leaves out dots that lie off; how many there are now.
std::int32_t leave_out(CalibrationData& data, double sigma_px) {
  std::int32_t count = 0;
  const double gate = std::max(kOutlier * sigma_px, 0.02);
  for (SeenDot& dot : data.dots) {
    dot.used = dot.residual_px.cwiseAbs().maxCoeff() <= gate;
    count += dot.used ? 0 : 1;
  }
  return count;
}

/// EFL and poses first, with the picture's middle as centre; then everything.
FitOutcome fit_in_steps(const FitOptions& options, CalibrationData& data, CalibrationState& state,
                        FitScratch& scratch) {
  FitOptions less = options;
  less.center_and_scale = false;
  static_cast<void>(fit_camera(less, data, state, scratch));
  return fit_camera(options, data, state, scratch);
}

/// Leaves dots out and fits again until none is left that lies off.
void clean(CalibrationData& data, CalibrationState& state, FitScratch& scratch,
           CalibrationOutcome& outcome) {
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const std::int32_t before = outcome.left_out;
    outcome.left_out = leave_out(data, outcome.fit.sigma_px);
    if (outcome.left_out == before) {
      return;
    }
    outcome.fit = fit_camera(outcome.freed, data, state, scratch);
  }
}

/// Frees one more thing where that explains the residuals far better than chance would.
void free_if_asked_for(bool FitOptions::*more, CalibrationData& data, CalibrationState& state,
                       FitScratch& scratch, CalibrationOutcome& outcome) {
  FitOptions options = outcome.freed;
  options.*more = true;
  CalibrationState trial = state;
  const FitOutcome fit = fit_camera(options, data, trial, scratch);
  if (fit.converged && fit.determined &&
      outcome.fit.sum_px2 - fit.sum_px2 > kAsksForIt * fit.sigma_px * fit.sigma_px) {
    outcome.fit = fit;
    outcome.freed = options;
    state = trial;
  } else {
    outcome.fit = fit_camera(outcome.freed, data, state, scratch);  // the residuals again
  }
}

}  // namespace

Verdict verdict_for(double map_rms_px) {
  return map_rms_px <= kForBase_px   ? Verdict::kBase
         : map_rms_px <= kForPose_px ? Verdict::kPose
                                     : Verdict::kTracking;
}

double map_sigma_px(const Sensor& sensor, const CameraValues& camera,
                    const math::Matrix6d& covariance, const Eigen::Vector2d& pixel) {
  constexpr double kStep = 1e-6;
  // The ray's slope times EFL in pixels: what an error of it moves in the picture.
  Eigen::Matrix<double, 2, 6> slope;
  for (int k = 0; k < 6; ++k) {
    const double step = kStep * std::max(1.0, std::abs(camera(k)));
    const CameraValues off = step * CameraValues::Unit(k);
    slope.col(k) = (ideal_of(sensor, camera + off, pixel) / (camera + off)(0) -
                    ideal_of(sensor, camera - off, pixel) / (camera - off)(0)) /
                   (2.0 * step);
  }
  slope.row(0) *= camera(0) * camera(1) / sensor.column_mm;
  slope.row(1) *= camera(0) / sensor.row_mm;
  return std::sqrt((slope * covariance * slope.transpose()).trace());
}

MapUncertainty map_uncertainty(const Sensor& sensor, const CameraValues& camera,
                               const math::Matrix6d& covariance) {
  constexpr int kColumns = 17;
  constexpr int kRows = 13;
  MapUncertainty result;
  double squares = 0.0;
  for (int i = 0; i < kColumns * kRows; ++i) {
    const Eigen::Vector2d pixel((i % kColumns) * (sensor.width_px - 1.0) / (kColumns - 1),
                                (i / kColumns) * (sensor.height_px - 1.0) / (kRows - 1));
    const double sigma_px = map_sigma_px(sensor, camera, covariance, pixel);
    squares += sigma_px * sigma_px;
    if (sigma_px > result.worst_px) {
      result.worst_px = sigma_px;
      result.worst_u_px = pixel.x();
      result.worst_v_px = pixel.y();
    }
  }
  result.rms_px = std::sqrt(squares / (kColumns * kRows));
  return result;
}

CalibrationOutcome calibrate_camera(CalibrationData& data, CalibrationState& state,
                                    FitScratch& scratch) {
  CalibrationOutcome outcome;
  const auto refuse = [&](CalibrationRefusal refusal) {
    outcome.refusal = refusal;
    return outcome;
  };
  if (const CalibrationRefusal wrong = check_views(data); wrong != CalibrationRefusal::kNone) {
    return refuse(wrong);
  }
  if (!start_from_views(data, state)) {
    return refuse(CalibrationRefusal::kNoStart);
  }
  outcome.fit = fit_in_steps(outcome.freed, data, state, scratch);
  const bool staged = std::count_if(data.views.begin(), data.views.end(),
                                    [](const CalibrationView& view) { return view.staged; }) > 1;
  math::Matrix6d lean = math::Matrix6d::Zero();
  if (staged) {
    lean = settle_stage_axis(data, state, scratch, outcome);
  }
  free_if_asked_for(&FitOptions::distortion2, data, state, scratch, outcome);
  clean(data, state, scratch, outcome);
  if (outcome.left_out > kMostLeftOut * data.dots.size()) {
    return refuse(CalibrationRefusal::kManyOutliers);
  }
  if (!outcome.fit.determined || !(state.camera(0) > 0.0)) {
    return refuse(CalibrationRefusal::kUndetermined);
  }
  if (!outcome.fit.converged) {
    return refuse(CalibrationRefusal::kNoFit);
  }
  outcome.fit.camera_covariance += lean;
  outcome.map = map_uncertainty(data.sensor, state.camera, outcome.fit.camera_covariance);
  if (outcome.fit.rms_px > kMostRms_px) {
    return refuse(CalibrationRefusal::kPoorFit);
  }
  const double sigma_of_focal = std::sqrt(outcome.fit.camera_covariance(0, 0)) / state.camera(0);
  if (!(sigma_of_focal < kMostOfFocal) || !std::isfinite(outcome.map.rms_px)) {
    return refuse(CalibrationRefusal::kUndetermined);
  }
  if (!(outcome.map.rms_px <= kForTracking_px)) {
    return refuse(CalibrationRefusal::kTooUncertain);
  }
  outcome.verdict = verdict_for(outcome.map.rms_px);
  return outcome;
}

}  // namespace tubesight::core::calibration
