#pragma once

#include "core/base/settings.h"

namespace tubesight::tests {

/// The source's camera as conventions state it: 635 by 480, strong barrel distortion.
[[nodiscard]] inline core::CameraSettings source_camera() {
  core::CameraSettings settings;
  settings.width_px = 635;
  settings.height_px = 480;
  settings.focal_length_mm = 5.06;
  settings.cell_width_mm = 0.0084;
  settings.cell_height_mm = 0.0098;
  settings.sensor_columns = 768;
  settings.frame_columns = 635;
  settings.horizontal_scale = 1.021;
  settings.center_px = {324.3, 233.8};
  settings.distortion_per_mm2 = 0.0092;
  return settings;
}

}  // namespace tubesight::tests
