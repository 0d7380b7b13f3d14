#pragma once

#include <type_traits>

#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "tests/support/source_camera.h"

namespace tubesight::core::camera {

using tests::source_camera;

/// A 12-megapixel camera with a similar field of view.
[[nodiscard]] inline CameraSettings large_camera() {
  CameraSettings settings;
  settings.width_px = 4096;
  settings.height_px = 3000;
  settings.focal_length_mm = 8.0;
  settings.cell_width_mm = 0.00253;
  settings.cell_height_mm = 0.00253;
  settings.sensor_columns = 4096;
  settings.frame_columns = 4096;
  settings.center_px = {2040.25, 1510.75};
  settings.distortion_per_mm2 = 0.0037;
  return settings;
}

/// One bound for each kind of arithmetic.
struct Bounds {
  double of_double;
  double of_float;
  double of_fixed;
};

template <typename S>
[[nodiscard]] constexpr double bound_of(const Bounds& bounds) {
  if constexpr (std::is_same_v<S, double>) {
    return bounds.of_double;
  } else if constexpr (std::is_same_v<S, float>) {
    return bounds.of_float;
  } else {
    return bounds.of_fixed;
  }
}

}  // namespace tubesight::core::camera
