#pragma once

#include "core/base/scalar.h"
#include "core/tracking/field_measurement.h"
#include "core/tracking/tracking_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::core::tracking {

/// Whether the settings' plugs and voids fit what the field shows far better where all addresses
/// are some steps off: what an operator who counted wrong, or a jump by whole steps, leaves.
///
/// Each site that looks open or closed agrees with what the settings say of its address, or
/// contradicts it. Where an offset of up to three steps each way has at least three contradictions
/// fewer, four if none that should be closed is open, and no more than a quarter of them, it is so.
/// Plugs that nobody listed and ones that fell out are no such pattern. Costs up to half a million
/// instructions, next to nothing where nothing contradicts.
template <Scalar S>
[[nodiscard]] bool fits_other_addresses(const TrackingModel<S>& model,
                                        const tubesheet::SheetMap& map,
                                        const FieldRecord<S>& record);

/// Whether the same is so anywhere along the row or the column, up to 128 steps away: a jump to
/// the sheet's edge, or to a void as large. For fields with more bright sites than tube-ends; costs
/// up to a million instructions.
template <Scalar S>
[[nodiscard]] bool fits_an_edge(const TrackingModel<S>& model, const tubesheet::SheetMap& map,
                                const FieldRecord<S>& record);

}  // namespace tubesight::core::tracking
