#pragma once

#include "core/base/scalar.h"
#include "core/tracking/field_measurement.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Whether sites that are bright, and should be open tube-ends, are one patch of the sheet: from
/// each of four fifths of them the others are reached by steps between neighbours. A glare or a
/// cloth is such a patch; a prediction that is off by part of a step leaves bright sites all over
/// the window.
///
/// True of none. Up to 24 sites, some 40 instructions a pair of them.
template <Scalar S>
[[nodiscard]] bool is_one_patch(const TrackingModel<S>& model, const SiteSightings::List& bright);

}  // namespace tubesight::core::tracking
