#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/scalar.h"
#include "core/tracking/rim_outline.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// A rim's bounding box in whole pixels.
struct RimBox {
  std::int32_t u = 0;
  std::int32_t v = 0;
  std::int32_t half_u = 0;
  std::int32_t half_v = 0;
};

template <Scalar S>
[[nodiscard]] RimBox box_of(const RimOutline<S>& rim) {
  return {rounded(rim.middle.x), rounded(rim.middle.y), rounded(rim.half_extent.x),
          rounded(rim.half_extent.y)};
}

/// Readings of a search for this rim: coarse ones need as many of them across the rim as there are
/// pixels across a small one.
template <Scalar S>
[[nodiscard]] std::int32_t reading_step(const TrackingModel<S>& model, const RimBox& box) {
  constexpr std::int32_t kReadings = 10;
  return std::clamp(box.half_v / kReadings, 1, model.reading_step_px);
}

}  // namespace tubesight::core::tracking
