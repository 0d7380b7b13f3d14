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

/// Why there is no pose.
enum class PoseRefusal : std::uint8_t {
  kNone,
  kTooFewTubes,          ///< fewer rims that can be used than asked for
  kCollinear,            ///< the tubes' centres lie on one line: the tilt about it is not held
  kAmbiguous,            ///< two poses fit the picture
  kResidualTooLarge,     ///< the rims are not where any pose puts them
  kAddressesContradict,  ///< mirrored, of the wrong scale, twice the same, or not in the lattice
  kIllConditioned,       ///< the tubes don't determine the pose
};

}  // namespace tubesight::core::pose
