#pragma once

#include "core/calibration/imaging.h"

namespace tubesight::core::calibration {

/// How far two maps from pixels to rays are apart over the picture.
struct MapDifference {
  double rms_px = 0.0;
  double worst_px = 0.0;
};

/// What a camera has wrong of a lens, which may have tangential distortion: a ray's place on the
/// ideal plane, in pixels. A turn of all rays together is no error: the tool's calibration and
/// every pose take it up. With `free_focal` EFL is none either: a docking tells it.
[[nodiscard]] MapDifference map_difference(const Sensor& sensor, const CameraValues& camera,
                                           const CameraValues& lens,
                                           const TangentialValues& tangential = {0.0, 0.0},
                                           bool free_focal = false);

}  // namespace tubesight::core::calibration
