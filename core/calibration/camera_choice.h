#pragma once

#include "core/calibration/camera_calibration.h"

namespace tubesight::core::calibration {

/// Leaves dots out that lie off and fits again until none is left that does.
void clean(CalibrationData& data, CalibrationState& state, FitScratch& scratch,
           CalibrationOutcome& outcome, const FitOptions& options);

/// From a camera fitted without them, the stage's axis settled: frees k2, a bow of the template and
/// tangential distortion where the residuals ask for it, leaves dots out, and counts what is no
/// noise in the covariance. The camera is the best one that settings can hold; what they can't is
/// told in the outcome.
void choose_model(CalibrationData& data, CalibrationState& state, FitScratch& scratch,
                  CalibrationOutcome& outcome);

}  // namespace tubesight::core::calibration
