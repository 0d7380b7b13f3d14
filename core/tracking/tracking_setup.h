#pragma once

#include <array>

#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/base/sighting.h"
#include "core/tracking/start.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// The numbers of the path for a session's settings; double precision, + - x / and square root
/// only, so that every machine gets the same. Writes `model`.
///
/// kOutOfRange: a value leaves the number formats; kIllConditioned: the lattice steps are parallel.
template <Scalar S>
[[nodiscard]] Result<void> make_tracking_model(const SessionSettings& settings,
                                               TrackingModel<S>& model);

/// An operator's clicks as the path takes them.
[[nodiscard]] StartClickList make_start_clicks(
    const StaticVector<StartPoint, kMaxStartPoints>& points);

/// A place of the picture as the path takes it.
[[nodiscard]] ImagePoint make_image_point(const std::array<double, 2>& at_px);

}  // namespace tubesight::core::tracking
