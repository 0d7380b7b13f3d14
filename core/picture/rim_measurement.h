#pragma once

#include <cstdint>

#include "core/picture/arc_edge.h"
#include "core/picture/averaged_picture.h"
#include "core/picture/rim.h"
#include "core/picture/rim_outline.h"

namespace tubesight::core::picture {

/// What was found where a tube-end was expected.
enum class RimFinding : std::uint8_t {
  kMeasured,    ///< enough of its edge, and the edge of one circle
  kPartly,      ///< an arc of it: the rest is hidden or outside the picture
  kOutside,     ///< too little of it is in the picture
  kTooSmall,    ///< the picture does not resolve it
  kBright,      ///< no dark inside: a plug, or no tube at all
  kNoEdge,      ///< too little edge where it was expected: a recessed plug, hidden, or too dark
  kOutOfShape,  ///< edges that do not continue each other
};

/// How rims are measured.
struct RimMeasureOptions {
  ArcEdgeOptions edge;
  double arc_px = 5.0;         ///< length of the pieces
  double least_half_px = 7.0;  ///< half the height or width of a rim that is measured
  double least_share = 0.3;    ///< of all pieces that must have kept an edge
  std::int32_t least_points = 10;
};

/// Measures the edge all around a predicted rim into `rim` (its address is left).
///
/// The pieces must agree with one shift and growth of the outline: those that do not, nicks,
/// glints, what hides the tube-end, are left out one after the other. Without its dark inside it is
/// none.
[[nodiscard]] RimFinding measure_rim(const AveragedPicture& picture, const RimOutline& outline,
                                     const RimMeasureOptions& options, Rim& rim);

}  // namespace tubesight::core::picture
