#pragma once

#include "core/calibration/calibration_data.h"

namespace tubesight::core::calibration {

/// Whether a view's dots stand out of a plane by more than 3 % of the template's width: then it
/// tells all of a camera alone.
[[nodiscard]] bool is_solid(const CalibrationData& data, const CalibrationView& view);

/// A camera and poses to begin a fit with, from views of a plane template or of known points in
/// space [Tsai1987].
///
/// Stage one, a view alone: a dot's image lies in the direction in which its place lies from the
/// optical axis, whatever EFL and radial distortion are; linear, with the optical axis taken in the
/// picture's middle and h_sx as 1 [Lenz1988 frees both, here the fit does]. Stage two: EFL and
/// distance, linear again, of all views together; the stage's heights tell them apart, or, of free
/// poses, their tilt. False: the views contradict each other or the heights, so that EFL or a
/// distance would be negative (heights swapped, a mirrored template).
[[nodiscard]] bool start_from_views(const CalibrationData& data, CalibrationState& state);

}  // namespace tubesight::core::calibration
