#pragma once

#include <cstdint>

#include "core/calibration/calibration_data.h"
#include "core/calibration/camera_fit.h"
#include "core/calibration/lens_misfit.h"
#include "core/calibration/residual_pattern.h"

namespace tubesight::core::calibration {

/// Why there is no calibration.
enum class CalibrationRefusal : std::uint8_t {
  kNone,
  kOneView,       ///< a single view of a plane: `assumed` tells whether anything is known from it
  kEqualHeights,  ///< the stage's views are all at one height
  kNoStart,       ///< EFL or a distance comes out negative: heights swapped, a mirrored template
  kNoFit,         ///< the fit does not come to rest
  kUndetermined,  ///< the views don't tell the parameters apart, whatever the residuals are
  kTooUncertain,  ///< they do, but the map is not known to 1 px: the outcome tells what there is
  kPoorFit,       ///< the dots are not where any camera of this model would show them
  kManyOutliers,  ///< so many dots off that the template or its order is in doubt
  kOtherLens,     ///< EFL is not that of the data sheet, or no lens sees as wide as that
  kPattern,       ///< the residuals are no noise: a bowed template, a lens that moved
};

/// What a calibration may be used for, by the map's uncertainty over the picture (its RMS).
enum class Verdict : std::uint8_t {
  kBase,      ///< also to calibrate the robot's base: the map is known to 0.05 px
  kPose,      ///< the tool's pose: 0.15 px
  kTracking,  ///< tracking and position correction: 1 px
};

/// The uncertainty of the map from pixels to rays, over the picture: one standard deviation of a
/// ray's place on the ideal plane, in pixels.
struct MapUncertainty {
  double worst_px = 0.0;
  double rms_px = 0.0;
  double worst_u_px = 0.0;  ///< where it is worst
  double worst_v_px = 0.0;
};

/// Tangential distortion that the dots show, which settings cannot hold.
struct FoundTangential {
  TangentialValues p = TangentialValues::Zero();  ///< per mm
  MapDifference map;                              ///< what the camera without it has wrong
  /// The stage's axis was freed, and a lens with p would show the same: a tilted view tells.
  bool rival = false;
};

/// How a calibration came out; `state` of the caller has the parameters.
struct CalibrationOutcome {
  CalibrationRefusal refusal = CalibrationRefusal::kNone;
  FitOutcome fit;
  /// k2, the stage's axis, a bow of the template and tangential distortion only where the residuals
  /// asked for it. Of the latter `tangential` tells; the camera is the best one without it.
  FitOptions freed;
  FoundTangential tangential;
  ResidualPattern pattern;
  bool patterned = false;  ///< more than noise leaves
  double grown = 1.0;      ///< what the covariance was multiplied with for that
  /// Of one view of a plane: centre and scale are not fitted, their uncertainty is assumed and is
  /// in the covariance.
  bool assumed = false;
  /// Of two heights alone: a lens that moved between them shows the same as another EFL with
  /// another distance, whatever the residuals are. By what share of itself EFL would be wrong for
  /// each share that it changed in between; 0: a change would show.
  double unseen_lens = 0.0;
  std::int32_t left_out = 0;  ///< dots that lie off by more than six standard deviations
  MapUncertainty map;
  /// What the verdict goes by: the map's RMS, twice that with a pattern, and what tangential
  /// distortion leaves. With `unseen_lens` it is for a pose at most.
  double judged_px = 0.0;
  Verdict verdict = Verdict::kTracking;
};

/// What a map known to so much, RMS over the picture and up to 1 px, may be used for.
[[nodiscard]] Verdict verdict_for(double map_rms_px);

/// The map's standard deviation at a pixel, for a covariance of the camera's parameters.
[[nodiscard]] double map_sigma_px(const Sensor& sensor, const CameraValues& camera,
                                  const math::Matrix6d& covariance, const Eigen::Vector2d& pixel);

/// The same over the whole picture.
[[nodiscard]] MapUncertainty map_uncertainty(const Sensor& sensor, const CameraValues& camera,
                                             const math::Matrix6d& covariance);

/// Calibrates a camera from views of a template: a start by radial alignment, all parameters and
/// poses together, dots left out that lie off, further unknowns where the residuals ask for them,
/// and what the result is worth. A low residual is no proof: two parallel planes without known
/// heights fit any EFL, so what is judged is the map's uncertainty.
[[nodiscard]] CalibrationOutcome calibrate_camera(CalibrationData& data, CalibrationState& state,
                                                  FitScratch& scratch);

}  // namespace tubesight::core::calibration
