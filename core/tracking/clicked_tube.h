#pragma once

#include <cstdint>

#include "core/base/image_view.h"
#include "core/base/scalar.h"
#include "core/edges/dynamic_threshold.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// How the tube-end around a click is looked for: by bisection, which is quick and right in a clean
/// picture, or as a circle of the sheet, which is neither misled by specks nor by blots.
enum class ClickSearch : std::uint8_t { kBisected, kRound };

/// The tube-end around a click, full-frame pixels.
struct ClickedTube {
  bool found = false;
  std::int32_t center_u_q16 = 0;
  std::int32_t center_v_q16 = 0;
  std::int32_t width_q16 = 0;
  std::int32_t height_q16 = 0;
  /// Grey level midway between its inside and the sheet around it; zero: was not looked at.
  std::int32_t midway = 0;
};

/// The circle of the sheet around a full-frame pixel, which is 80 % of the radius off its centre at
/// most; see edges::find_round_region().
template <Scalar S>
[[nodiscard]] ClickedTube find_circle(const TrackingModel<S>& model, const FieldView& field,
                                      std::int32_t u_px, std::int32_t v_px);

/// Looks for the dark tube-end around a full-frame pixel, which may be 60 % of the radius off its
/// centre. As a circle it is looked for from up to nine places: the click may be under a bright
/// spot.
template <Scalar S>
[[nodiscard]] ClickedTube find_clicked_tube(const TrackingModel<S>& model, const FieldView& field,
                                            std::int32_t u_px, std::int32_t v_px,
                                            ClickSearch search,
                                            const edges::DynamicThreshold& threshold);

}  // namespace tubesight::core::tracking
