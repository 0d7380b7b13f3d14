#pragma once

#include "core/calibration/calibration_data.h"
#include "core/calibration/camera_calibration.h"
#include "core/calibration/camera_fit.h"

namespace tubesight::core::calibration {

/// How far a stage's axis leans from the template's normal, one sigma each way: 0.2 degrees, of a
/// stage and a template that were set up with care. Assumed where the views don't tell it.
inline constexpr double kStageLean_rad = 0.0035;

/// Decides what a stage's axis is: freed in `outcome` where the views say that it leans; else the
/// template's normal. Returns what is to be added to the camera's covariance: where the views would
/// not show a lean, it may be there all the same; where they do, a template that was moved aside
/// makes them look so, too. A lean that no stage has frees nothing.
///
/// Seen square to the template a leaning axis looks like another centre of the picture. A lens
/// with little distortion does not tell the two apart: residuals stay small, and the centre is
/// off by more than a hundred times what a fit with the axis held would promise.
///
/// `outcome.fit` is a fit with the axis held. Leaves state and residuals of the choice.
[[nodiscard]] math::Matrix6d settle_stage_axis(CalibrationData& data, CalibrationState& state,
                                               FitScratch& scratch, CalibrationOutcome& outcome);

}  // namespace tubesight::core::calibration
