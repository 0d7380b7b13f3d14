#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/settings.h"
#include "drivers/camera/camera_identity.h"

namespace tubesight::drivers {

/// How a buffer holds the fields of an interlaced camera.
enum class FieldLayout : std::uint8_t {
  kAny,         ///< the first of the following that the driver has
  kInterlaced,  ///< both, line by line
  kAlternate,   ///< one a buffer: there is no wait for the second
  kSequential,  ///< both, one below the other
};

/// A control of the camera and what it is to be set to.
struct ControlSetting {
  std::string name;   ///< as the driver calls it, letters of either case: "Gain"
  std::string value;  ///< a whole number, or an entry of a menu by its name
};

/// A camera behind V4L2 and what is wanted of it.
struct V4l2Settings {
  /// A path below /dev/v4l, "bus:" and the bus path that the driver tells, or "serial:" and the
  /// serial number: what stays when devices are numbered anew.
  std::string device;
  CameraIdentity calibrated;  ///< what the calibration says of its camera
  std::string format;         ///< "GREY" ...; empty: the best that there is
  FieldLayout fields = FieldLayout::kAny;
  std::string input;          ///< by its name; empty: the one that is chosen
  std::string standard;       ///< "NTSC", "PAL"; empty: as it is
  double fields_per_s = 0.0;  ///< 0: as the driver says
  double exposure_ms = 0.0;   ///< 0: a field's whole time
  bool use_stamps = true;     ///< no: a driver's that are known to be wrong, by arrival alone
  std::vector<ControlSetting> controls;
  std::int32_t width_px = 0;   ///< of the full frame
  std::int32_t height_px = 0;  ///< of the full frame
  core::Scan scan = core::Scan::kEvenFirst;
};

}  // namespace tubesight::drivers
