#include "core/calibration/camera_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/calibration/camera_choice.h"
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
constexpr double kMostLeftOut = 0.1;  // of the dots

// Of one view: an analog camera's scale and any camera's centre, where nobody measured them.
constexpr double kScaleAssumed = 0.02;
constexpr double kCenterAssumed = 0.025;  // of the picture's width
constexpr double kMostOfFocalOneView = 0.1;

constexpr double kSameAngle = 0.9961946980917455;  // the cosine of 5 degrees

// Errors that hang together keep to no normal distribution: twice the standard deviation counts.
constexpr double kPatternDoubt = 2.0;
constexpr double kMuchPattern = 4.0;  // growth of the covariance that is the reason of a refusal

// EFL of a lens at another focus than its data sheet's differs by some percent.
constexpr double kLikeLens = 0.2;
constexpr double kWidest = 1.7320508075688772;  // the slope of 60 degrees, as core/camera takes it

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
  if (data.views.size() == 0) {
    return CalibrationRefusal::kOneView;
  }
  // A stage with one view beside free poses is a free pose of its own.
  return staged > 1 && !(most > least) ? CalibrationRefusal::kEqualHeights
                                       : CalibrationRefusal::kNone;
}

/// As CalibrationOutcome::unseen_lens. A square view tells EFL over its distance alone, f / z; with
/// z2 - z1 = h known, f = h / (z2 / f - z1 / f), so that a change d of f before the second view
/// makes f wrong by d z2 / h. A third height, or one of the two again, has the two disagree; three
/// free poses tell EFL by themselves.
double unseen_lens(const CalibrationData& data, const CalibrationState& state) {
  constexpr std::int32_t kEnoughFree = 3;
  std::int32_t staged = 0;
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  double farthest_mm = 0.0;
  for (std::int32_t i = 0; i < data.views.size(); ++i) {
    if (data.views[i].staged) {
      ++staged;
      least = std::min(least, data.views[i].height_mm);
      most = std::max(most, data.views[i].height_mm);
      farthest_mm = std::max(farthest_mm, state.poses[i].t_camera_target.z());
    }
  }
  return staged == 2 && data.views.size() - staged < kEnoughFree ? farthest_mm / (most - least)
                                                                 : 0.0;
}

/// EFL and poses first, with the picture's middle as centre; then everything.
FitOutcome fit_in_steps(const FitOptions& options, CalibrationData& data, CalibrationState& state,
                        FitScratch& scratch) {
  FitOptions less = options;
  less.center_and_scale = false;
  static_cast<void>(fit_camera(less, data, state, scratch));
  return fit_camera(options, data, state, scratch);
}

/// Whether free views of a plane all see it under one angle, however it is turned in itself or
/// shifted. Such planes share their vanishing line, and what tells EFL of a view lies on it: all of
/// them tell what one does.
bool see_one_angle(const CalibrationData& data, const CalibrationState& state) {
  for (std::int32_t i = 0; i < data.views.size(); ++i) {
    if (is_solid(data, data.views[i])) {
      return false;
    }
    for (std::int32_t k = 0; k < i; ++k) {
      const double cosine =
          state.poses[i].R_camera_target.col(2).dot(state.poses[k].R_camera_target.col(2));
      if (cosine < kSameAngle) {
        return false;
      }
    }
  }
  return true;
}

/// Whether the camera can be that of the data sheet, and any that core/camera takes.
bool is_like_lens(const CalibrationData& data, const CameraValues& camera) {
  if (data.lens_mm > 0.0 && std::abs(std::log(camera(0) / data.lens_mm)) > kLikeLens) {
    return false;
  }
  double widest = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector2d pixel((corner & 1) * (data.sensor.width_px - 1.0),
                                (corner >> 1) * (data.sensor.height_px - 1.0));
    widest = std::max(widest, ideal_of(data.sensor, camera, pixel).norm() / camera(0));
  }
  return widest < kWidest;
}

/// One view of a plane: EFL, k and the pose, with centre and scale assumed and that uncertainty
/// carried on. Says whether that tells anything.
bool fit_one_view(CalibrationData& data, CalibrationState& state, FitScratch& scratch,
                  CalibrationOutcome& outcome) {
  // How far a camera's centre lies from the picture's middle, and h_sx from 1, where nobody
  // measured them.
  const std::array<double, 3> assumed = {kScaleAssumed, kCenterAssumed * data.sensor.width_px,
                                         kCenterAssumed * data.sensor.width_px};
  FitOptions options;
  options.center_and_scale = false;
  outcome.fit = fit_camera(options, data, state, scratch);
  clean(data, state, scratch, outcome, options);
  if (!outcome.fit.converged || !outcome.fit.determined || !(state.camera(0) > 0.0)) {
    return false;
  }
  for (std::size_t i = 0; i < assumed.size(); ++i) {
    scratch.more = state;
    scratch.more.camera(static_cast<Eigen::Index>(i) + 1) += assumed[i];
    const FitOutcome off = fit_camera(options, data, scratch.more, scratch);
    if (!off.converged) {
      return false;
    }
    const CameraValues change = scratch.more.camera - state.camera;
    outcome.fit.camera_covariance += change * change.transpose();
  }
  static_cast<void>(fit_camera(options, data, state, scratch));  // the residuals again
  outcome.map = map_uncertainty(data.sensor, state.camera, outcome.fit.camera_covariance);
  const double sigma = std::sqrt(outcome.fit.camera_covariance(0, 0));
  return std::isfinite(sigma) && sigma < kMostOfFocalOneView * state.camera(0);
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
  const bool one_plane = data.views.size() == 1 && !is_solid(data, data.views[0]);
  if (!start_from_views(data, state)) {
    return refuse(one_plane ? CalibrationRefusal::kOneView : CalibrationRefusal::kNoStart);
  }
  if (one_plane) {
    outcome.assumed = fit_one_view(data, state, scratch, outcome);
    return refuse(CalibrationRefusal::kOneView);
  }
  outcome.fit = fit_in_steps(outcome.freed, data, state, scratch);
  const bool staged = std::count_if(data.views.begin(), data.views.end(),
                                    [](const CalibrationView& view) { return view.staged; }) > 1;
  math::Matrix6d lean = math::Matrix6d::Zero();
  if (staged) {
    lean = settle_stage_axis(data, state, scratch, outcome);
  }
  choose_model(data, state, scratch, outcome);
  if (outcome.left_out > kMostLeftOut * data.dots.size()) {
    return refuse(CalibrationRefusal::kManyOutliers);
  }
  if (!outcome.fit.determined || !(state.camera(0) > 0.0) ||
      (!staged && see_one_angle(data, state))) {
    return refuse(CalibrationRefusal::kUndetermined);
  }
  if (!outcome.fit.converged) {
    return refuse(CalibrationRefusal::kNoFit);
  }
  outcome.fit.camera_covariance += lean;
  outcome.map = map_uncertainty(data.sensor, state.camera, outcome.fit.camera_covariance);
  outcome.judged_px = std::hypot((outcome.patterned ? kPatternDoubt : 1.0) * outcome.map.rms_px,
                                 outcome.tangential.map.rms_px);
  if (!is_like_lens(data, state.camera)) {
    return refuse(CalibrationRefusal::kOtherLens);
  }
  if (outcome.fit.rms_px > kMostRms_px) {
    return refuse(CalibrationRefusal::kPoorFit);
  }
  const double sigma_of_focal = std::sqrt(outcome.fit.camera_covariance(0, 0)) / state.camera(0);
  if (!(outcome.judged_px <= kForTracking_px) && outcome.grown > kMuchPattern) {
    return refuse(CalibrationRefusal::kPattern);
  }
  if (!(sigma_of_focal < kMostOfFocal) || !std::isfinite(outcome.map.rms_px)) {
    return refuse(CalibrationRefusal::kUndetermined);
  }
  if (!(outcome.judged_px <= kForTracking_px)) {
    return refuse(CalibrationRefusal::kTooUncertain);
  }
  outcome.unseen_lens = unseen_lens(data, state);
  outcome.verdict = std::max(verdict_for(outcome.judged_px),
                             outcome.unseen_lens > 0.0 ? Verdict::kPose : Verdict::kBase);
  return outcome;
}

}  // namespace tubesight::core::calibration
