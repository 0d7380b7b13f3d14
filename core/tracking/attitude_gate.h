#pragma once

#include <cstdint>

#include "core/base/scalar.h"
#include "core/base/sighting.h"
#include "core/tracking/motion.h"
#include "core/tracking/sheet_observer.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Whether of the tube-ends looked at so few agree that it is less than one `part`-th of the share
/// that did in the last good field; false where fewer than six were
/// looked at in either.
template <Scalar S>
[[nodiscard]] bool few_are_left(const Observation<S>& seen, const Observation<S>& last,
                                std::int32_t part);

/// The gate for what ToolGate leaves of the six numbers of a pose: height, heading and lean.
///
/// Each has a greatest speed and a greatest acceleration in [motion]. A picture is believed only if
/// it shows each within what they allow since the last good one, and what both pictures leave
/// uncertain. Before a motion is known the speeds alone limit them.
///
/// Why a field is not believed: kJump where it is farther from the prediction than accelerations
/// allow, kSpeed where nothing changes so fast, kNoTubes where of the tube-ends that the last good
/// one agreed on next to none is left: two or three fit any pose. `last` is the last good field.
template <Scalar S>
[[nodiscard]] Reason refuses_attitude(const TrackingModel<S>& model, const Observation<S>& seen,
                                      const SheetPose<S>& predicted, Mm<S> predicted_height_mm,
                                      const Observation<S>& last, const Motion<S>& motion,
                                      Unit<S> span_s);

}  // namespace tubesight::core::tracking
