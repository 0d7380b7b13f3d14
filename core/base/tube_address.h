#pragma once

#include <compare>
#include <cstdint>

namespace tubesight::core {

/// Names a tube of the tubesheet as the plant numbers it; both numbers are signed.
struct TubeAddress {
  std::int32_t row = 0;
  std::int32_t column = 0;

  friend constexpr auto operator<=>(const TubeAddress&, const TubeAddress&) = default;
};

/// What stands at an address of the lattice.
enum class TubeState : std::uint8_t {
  kOpen,     ///< an open tube-end
  kPlugged,  ///< a plug: the tube keeps its address but its rim is not in the plane
  kAbsent,   ///< no tube: a void, an address outside the sheet or one that the parity leaves out
};

}  // namespace tubesight::core
