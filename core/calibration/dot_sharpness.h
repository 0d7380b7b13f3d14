#pragma once

#include <cstdint>

#include "core/detection/lattice_finder.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::core::calibration {

/// How sharp a picture shows the dots of a template, and whether the sensor was at its limit.
struct DotSharpness {
  std::int32_t dots = 0;       ///< looked at: those with room around them
  double radius_px = 0.0;      ///< of a dot, in the mean
  double width_px = 0.0;       ///< of the edges where they are sharpest: contrast by steepest slope
  double smeared_px = 0.0;     ///< what they are wider along the one direction than across it
  double smeared_deg = 0.0;    ///< that direction, 0 up to 180, from u towards v
  std::int32_t saturated = 0;  ///< dots at the top of the grey levels
  std::int32_t ground_saturated = 0;  ///< dots whose surroundings are
};

/// Why such dots are no place to measure from.
enum class DotFault : std::uint8_t {
  kNone,
  kSaturated,  ///< their level is cut off: the edge is not where it seems
  kSmeared,    ///< something moved while the picture was exposed
  kBlurred,    ///< far out of focus
};

/// Looks across each dot's edge in 16 directions. Motion widens an edge by what lies along it, so
/// that squares of widths go round as a + b cos 2 phi + c sin 2 phi over the directions phi of the
/// edges' normals; what a lens or a line of video smears is small against the limits of
/// fault_of().
[[nodiscard]] DotSharpness dot_sharpness(const picture::AveragedPicture& picture,
                                         const detection::FoundLattice& found);

/// Whether dots so sharp may be measured. Dark dots on paper that is too bright may: they come out
/// smaller, all alike.
[[nodiscard]] DotFault fault_of(const DotSharpness& sharpness);

}  // namespace tubesight::core::calibration
