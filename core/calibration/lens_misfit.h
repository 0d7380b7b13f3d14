#pragma once

#include <cstdint>

#include "core/calibration/imaging.h"

namespace tubesight::core::calibration {

/// What between two maps is no error.
enum class MapGauge : std::uint8_t {
  kNone,
  kTurn,          ///< a turn of all rays together: the tool's calibration and every pose take it up
  kTurnAndFocal,  ///< EFL, too: a docking tells it
};

/// How far two maps from pixels to rays are apart over the picture.
struct MapDifference {
  double rms_px = 0.0;
  double worst_px = 0.0;
};

/// What a camera has wrong of a lens, which may have tangential distortion: a ray's place on the
/// ideal plane, in pixels, counted as in MapUncertainty.
[[nodiscard]] MapDifference map_difference(const Sensor& sensor, const CameraValues& camera,
                                           const CameraValues& lens,
                                           const TangentialValues& tangential = {0.0, 0.0},
                                           MapGauge gauge = MapGauge::kTurn);

}  // namespace tubesight::core::calibration
