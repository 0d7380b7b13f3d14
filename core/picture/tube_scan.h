#pragma once

#include <array>
#include <cstdint>

#include "core/picture/averaged_picture.h"
#include "core/picture/rim.h"

namespace tubesight::core::picture {

/// Why a place of the picture gave no tube-end.
enum class ScanRefusal : std::uint8_t {
  kNone,
  kOutside,     ///< the place is not in the picture, or at its very border
  kNotDark,     ///< the place is on the sheet, not inside a tube-end
  kNoBoundary,  ///< no edges all around it
  kFewEdges,    ///< too few edge points that continue each other
};

/// How the 24-pixel operator looks for edges.
struct ScanOptions {
  std::int32_t initial_threshold = 200;  ///< sum of 24 grey values' differences [Fallon eq. 5.1]
  std::int32_t reach_px = 240;           ///< a tube-end's edge is nearer than this to its middle
};

/// A tube-end as the source's scan finds it.
struct TubeScan {
  ScanRefusal refusal = ScanRefusal::kNone;
  std::array<double, 4> box_px{};  ///< left, top, right, bottom of the dark
};

/// Finds the edge of the tube-end around a place by the source's search [Fallon 5.1.1]: vertical
/// and horizontal boundaries, each bisected, the vertical ones twice; then rows and columns
/// outwards from the middle with the 24-pixel operator of Eq. 5.1, thresholds at 75 % of the
/// gradient before and halved where an edge is difficult, and a continuity constraint.
///
/// `u_px`, `v_px`: anywhere in the dark up to 60 % of the radius off the middle. Writes the points
/// of `rim`, to some tenths of a pixel along the search direction; their normals are not measured.
/// The address of `rim` is left. Costs some 0.1 ms a tube-end.
[[nodiscard]] TubeScan scan_tube(const AveragedPicture& picture, double u_px, double v_px,
                                 const ScanOptions& options, Rim& rim);

}  // namespace tubesight::core::picture
