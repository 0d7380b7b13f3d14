#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/settings.h"
#include "drivers/camera/camera_identity.h"

namespace tubesight::drivers {

/// A camera behind Aravis (GigE Vision, USB3 Vision) and what is wanted of it.
struct AravisSettings {
  /// "address:" and the camera's address, or "serial:" and its serial number: then it is looked for
  /// by a broadcast on all networks at each opening.
  std::string device;
  CameraIdentity calibrated;   ///< what the calibration says of its camera
  std::string format;          ///< "Mono8" ...; empty: the best that there is
  std::int32_t left_px = 0;    ///< of the region on the sensor
  std::int32_t top_px = 0;     ///< of the region on the sensor
  std::int32_t binning = 1;    ///< both ways
  double fields_per_s = 0.0;   ///< 0: as the camera is set
  double exposure_ms = 0.0;    ///< 0: as the camera is set
  std::optional<double> gain;  ///< in the camera's own unit; none: as it is set
  std::string trigger;         ///< the line that begins each exposure; empty: the camera's own rate
  std::int32_t packet_bytes = 0;  ///< 0: negotiated
  bool resend = false;            ///< ask for lost packets again
  double readout_ms = 0.0;        ///< end of exposure to arrival; 0: as long as the shortest frame
  std::int32_t width_px = 0;      ///< of the full frame
  std::int32_t height_px = 0;     ///< of the full frame
  core::Scan scan = core::Scan::kProgressive;
  std::int32_t priority = 0;  ///< of the thread that receives: SCHED_FIFO; 0: as every other
};

}  // namespace tubesight::drivers
