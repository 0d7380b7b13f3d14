#pragma once

#include <array>
#include <cstdint>

#include "core/base/settings.h"
#include "core/base/tube_address.h"

namespace tubesight::core::tubesheet {

// What follows from an address alone; where its tube stands is in tubesheet_setup.h and lattice.h.

/// Whether the row's number is odd, negative ones included.
[[nodiscard]] constexpr bool in_odd_row(TubeAddress address) { return (address.row & 1) != 0; }

/// Whether a numbering has this address at all.
[[nodiscard]] constexpr bool exists(AddressParity addresses, TubeAddress address) {
  const bool odd = ((address.row ^ address.column) & 1) != 0;
  return addresses == AddressParity::kAll || odd == (addresses == AddressParity::kOddSum);
}

/// Two short steps that lead from each address of a numbering to others of it, and by way of them
/// to all; perhaps not the shortest.
[[nodiscard]] constexpr std::array<TubeAddress, 2> spanning_steps(AddressParity addresses) {
  if (addresses == AddressParity::kAll) {
    return {{{1, 0}, {0, 1}}};
  }
  return {{{1, 1}, {1, -1}}};
}

[[nodiscard]] constexpr TubeAddress sum(TubeAddress a, TubeAddress b) {
  return {a.row + b.row, a.column + b.column};
}

[[nodiscard]] constexpr TubeAddress difference(TubeAddress a, TubeAddress b) {
  return {a.row - b.row, a.column - b.column};
}

}  // namespace tubesight::core::tubesheet
