#pragma once

#include "core/calibration/calibration_data.h"

namespace tubesight::core::calibration {

/// What of the residuals is no noise: errors of neighbouring dots that hang together, as a bowed or
/// misprinted template, a lens that moved or another kind of distortion leaves them.
struct ResidualPattern {
  double rms_px = 0.0;  ///< of the smooth part, of a dot
  /// Mean square of the smooth part over that of the rest, each by its degrees of freedom: 1 or
  /// less for noise, as the fit has taken its share of the smooth part.
  double ratio = 0.0;
  double spread = 0.0;    ///< one standard deviation of the ratio for noise
  double mean_px2 = 0.0;  ///< of the smooth part, by its degrees of freedom
};

/// The residuals of each view as a cubic of the place on the template, ten numbers a coordinate,
/// and what is left of them. Views of fewer than 40 dots are passed over.
[[nodiscard]] ResidualPattern residual_pattern(const CalibrationData& data);

}  // namespace tubesight::core::calibration
