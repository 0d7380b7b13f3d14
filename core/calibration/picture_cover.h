#pragma once

#include "core/calibration/camera_calibration.h"

namespace tubesight::core::calibration {

/// The part of a picture in which no dot was seen.
struct UncoveredPart {
  double share = 0.0;  ///< of the picture
  double u_px = 0.0;   ///< its middle
  double v_px = 0.0;
  double rms_px = 0.0;  ///< the map's uncertainty there, which the model alone carries that far
};

/// Finds what lies farther from every dot used than a sixth of the picture's height.
[[nodiscard]] UncoveredPart uncovered_part(const CalibrationData& data, const CameraValues& camera,
                                           const math::Matrix6d& covariance);

}  // namespace tubesight::core::calibration
