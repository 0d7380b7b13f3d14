#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/base/image_view.h"
#include "core/base/transform.h"

namespace tubesight::core::rendering {

/// A full-frame 8-bit grey picture to draw into, owned by the caller.
struct GreyImageView {
  std::uint8_t* pixels = nullptr;  ///< top-left pixel
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::int32_t stride_px = 0;  ///< from one line to the next, at least width_px
};

/// The whole picture, of whatever size.
inline constexpr PixelBox kWholePicture = {0, 0, std::numeric_limits<std::int32_t>::max(),
                                           std::numeric_limits<std::int32_t>::max()};

/// Dead lamps of the lighthouse: bit n stands for the lamp at n * 30 degrees from the tool's x.
inline constexpr std::int32_t kLighthouseLamps = 12;

/// One field's exposure: where everything is, how bright, and what to draw.
struct Exposure {
  Transform<frames::Sheet, frames::Tool> opened;  ///< when the shutter opens
  Transform<frames::Sheet, frames::Tool> closed;  ///< when it closes; the same: nothing is blurred
  /// The camera knocked loose: coordinates of the calibrated camera frame into those of the camera
  /// as it sits now. Identity by default.
  Transform<frames::Camera, frames::Camera> knock;
  double lamp = 1.0;             ///< lighthouse's mean light over the exposure, 0..1 of full
  std::uint32_t dead_lamps = 0;  ///< mask of kLighthouseLamps bits
  double ring = 0.0;             ///< camera's own LEDs, 0..1
  double gain = 1.0;             ///< faults: factor of the grey levels (0: no signal)
  double offset = 0.0;           ///< faults: added to the grey levels (255: white)
  double extra_noise = 0.0;      ///< faults: further noise, sigma in grey levels
  Parity parity = Parity::kProgressive;  ///< the lines to draw
  std::uint64_t noise_seed = 0;          ///< the same seed: the same noise
  PixelBox window = kWholePicture;       ///< what lies outside is left as it is
};

/// The share of an exposure that a lamp dimmed by pulses is lit, as Exposure::lamp wants it.
///
/// `duty` 0..1 of each `period_s`, lit from the period's start (time 0 begins one); shutter from
/// `opened_s` to `closed_s`. An exposure of whole periods gives `duty`, a short one flickers.
[[nodiscard]] double pulsed_light(double duty, double period_s, double opened_s, double closed_s);

}  // namespace tubesight::core::rendering
