#include "core/calibration/camera_type.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/lens_misfit.h"

namespace tubesight::core::calibration {

void widen_to_type(const Sensor& sensor, const CameraValues& camera, const UnitScatter& scatter,
                   CalibrationOutcome& outcome) {
  CameraValues sigma;
  sigma << scatter.focal * camera(0), scatter.scale * camera(1), scatter.center_px,
      scatter.center_px, scatter.distortion * camera(4), scatter.distortion2 * camera(5);
  outcome.fit.camera_covariance.diagonal() += sigma.cwiseAbs2();
  double squares = outcome.map.rms_px * outcome.map.rms_px;
  double worst = outcome.map.worst_px * outcome.map.worst_px;
  for (int i = 0; i < 6; ++i) {
    const MapDifference off =
        map_difference(sensor, camera, camera + sigma(i) * CameraValues::Unit(i), {0.0, 0.0},
                       MapGauge::kTurnAndFocal);
    squares += off.rms_px * off.rms_px;
    worst += off.worst_px * off.worst_px;
  }
  outcome.map.rms_px = std::sqrt(squares);
  outcome.map.worst_px = std::sqrt(worst);
  outcome.verdict = Verdict::kTracking;
}

}  // namespace tubesight::core::calibration
