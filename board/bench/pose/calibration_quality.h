#pragma once

#include "core/math/small_matrix.h"
#include "core/pose/calibration_uncertainty.h"
#include "drivers/settings/session_settings.h"

namespace tubesight::board {

/// The covariance of the six values that a quality table is of, in its order and units; all zero
/// where it has no sigma.
[[nodiscard]] core::math::Matrix6d covariance_of(const drivers::CalibrationQuality& quality);

/// How well the camera and the tool of a session are known, by what their calibrations say of
/// themselves; zero, which is exact, where they say nothing.
[[nodiscard]] core::pose::CalibrationUncertainty uncertainty_of(const drivers::SessionFile& file);

}  // namespace tubesight::board
