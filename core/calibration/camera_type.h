#pragma once

#include "core/calibration/camera_calibration.h"

namespace tubesight::core::calibration {

/// How far a camera is from another one of its type, lens and digitizer, one standard deviation:
/// what lens mounts and makers' tolerances leave. Assumed.
struct UnitScatter {
  double focal = 0.01;        ///< of EFL
  double scale = 0.001;       ///< of h_sx
  double center_px = 4.0;     ///< of c_u and of c_v
  double distortion = 0.03;   ///< of k
  double distortion2 = 0.03;  ///< of k2
};

/// Makes of a camera's calibration that of its type, for a camera that has none of its own: the
/// scatter from unit to unit joins the covariance, and the verdict is for tracking alone. The map's
/// uncertainty becomes that which is left when a docking has told EFL and where the rays point.
void widen_to_type(const Sensor& sensor, const CameraValues& camera, const UnitScatter& scatter,
                   CalibrationOutcome& outcome);

}  // namespace tubesight::core::calibration
