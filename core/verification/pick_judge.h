#pragma once

#include "core/base/event.h"
#include "core/base/reply.h"
#include "core/base/scalar.h"
#include "core/tracking/tracking_model.h"
#include "core/tubesheet/sheet_map.h"
#include "core/verification/recent_fields.h"

namespace tubesight::core::verification {

/// Names the tube at the place of a pick, as the sheet stood in the field that was seen: the tube
/// whose cell holds the point. `recent` has the present field as its last; one thread, no heap.
template <Scalar S>
[[nodiscard]] PickReply judge_pick(const Pick& pick, const RecentFields<S>& recent,
                                   const tracking::TrackingModel<S>& model,
                                   const tubesheet::SheetMap& map);

}  // namespace tubesight::core::verification
