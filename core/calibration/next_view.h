#pragma once

#include <cstdint>

#include "core/calibration/camera_calibration.h"
#include "core/calibration/halves.h"

namespace tubesight::core::calibration {

/// How one more view of the template stands.
enum class NextView : std::uint8_t {
  kUpperNearer,  ///< tilted by 30 degrees, the edge nearer to the camera that is up in the picture
  kLowerNearer,
  kLeftNearer,
  kRightNearer,
  kSquare,  ///< square to the camera, moved to where the map is known least
};

/// The view that helps most, and what it would bring.
struct NextViewOutcome {
  bool told = false;  ///< false: there is no room for one more view, or none betters the map
  NextView view = NextView::kSquare;
  double map_rms_px = 0.0;  ///< of the map with it
};

/// Tries one more view, of a free pose, at the distance of the others, for what it would leave
/// uncertain of the map. Of `scratch` everything is used. Five fits.
[[nodiscard]] NextViewOutcome find_next_view(const CalibrationData& data,
                                             const CalibrationState& state,
                                             const CalibrationOutcome& outcome,
                                             HalvesScratch& scratch);

}  // namespace tubesight::core::calibration
