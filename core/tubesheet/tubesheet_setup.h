#pragma once

#include <array>

#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/tubesheet/lattice.h"

namespace tubesight::core::tubesheet {

/// The lattice of a tubesheet, with the shortest steps between its existing addresses found.
///
/// kIllConditioned: the steps are parallel to 5 degrees. kOutOfRange: the shortest distance between
/// tubes is below 2 mm, a step above 500 mm or the shift of odd rows above a column step.
template <Scalar S>
[[nodiscard]] Result<Lattice<S>> make_lattice(const TubesheetSettings& settings);

/// Centre of an address by the lattice, sheet frame, mm.
[[nodiscard]] std::array<double, 2> center_mm(const TubesheetSettings& settings,
                                              TubeAddress address);

/// The same by a lattice made, whose tube (0, 0) stands at `origin_mm`.
[[nodiscard]] std::array<double, 2> center_mm(const Lattice<double>& lattice,
                                              const std::array<double, 2>& origin_mm,
                                              TubeAddress address);

/// Distance between the nearest two tubes of the numbering, whatever stands there, mm. The steps
/// must have a length and not be parallel.
[[nodiscard]] double shortest_step_mm(const TubesheetSettings& settings);

}  // namespace tubesight::core::tubesheet
