#pragma once

#include "core/base/image_view.h"
#include "core/base/scalar.h"
#include "core/tracking/sheet_observer.h"
#include "core/tracking/start.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Takes an operator's clicks in one field for what they say, if the whole window confirms it.
///
/// Where bisection does not lead to a start, the clicked tube-ends are looked for as circles. The
/// rough pose of the clicked tube-ends (find_start_pose()) is refined on all that the window
/// shows until it settles; half of what should be there must be, and each click must lie within the
/// bore of the very tube that it was given the address of, and of the sites that the settings say
/// are closed no more than two may look open. `seen` is fitted on kNone only.
template <Scalar S>
[[nodiscard]] StartAnswer find_confirmed_start(StartSearch<S>& search, SheetObserver<S>& observer,
                                               Observation<S>& seen);

}  // namespace tubesight::core::tracking
