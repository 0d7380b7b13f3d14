#pragma once

#include <cstdint>

namespace tubesight::core::pose {

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
