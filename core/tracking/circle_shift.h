#pragma once

#include "core/base/scalar.h"
#include "core/tracking/candidates.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// shift_onto_dark_regions() by circles, for pictures that mislead a bisection: specks, a ghost.
///
/// Looks for the circles around the predicted centres of the first four open tube-ends, which may
/// be 80 % of the bore's radius off. False unless two of those found agree, and half of them. Costs
/// some 7 million instructions.
template <Scalar S>
[[nodiscard]] bool shift_onto_circles(const TrackingModel<S>& model, const FieldView& field,
                                      const CandidateList<S>& candidates, Mm<S> reach_mm,
                                      SheetPose<S>& pose);

}  // namespace tubesight::core::tracking
