#pragma once

#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/tubesheet/lattice.h"

namespace tubesight::core::tubesheet {

/// The lattice of a tubesheet, with the shortest steps between its existing addresses found.
///
/// kIllConditioned: the steps are parallel to 5 degrees. kOutOfRange: the shortest step is below
/// 2 mm or a step above 500 mm.
template <Scalar S>
[[nodiscard]] Result<Lattice<S>> make_lattice(const TubesheetSettings& settings);

}  // namespace tubesight::core::tubesheet
