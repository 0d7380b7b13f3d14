#pragma once

#include <cstdint>

namespace tubesight::core::pose {

/// What the pose is fitted to.
enum class PoseMethod : std::uint8_t {
  kRims,            ///< all rim points at once: the optimum and the default
  kCenters,         ///< n points: ellipses' centres, their eccentricity found from the pose itself
  kTangentPoints,   ///< n points: joins of opposite tangent points [Fallon fig. 5.12]
  kTangentLines,    ///< n points: diagonals of tangent lines [Fallon fig. 5.13]
  kEllipseCenters,  ///< n points: ellipses' centres as they are; biased, for comparison
};

}  // namespace tubesight::core::pose
