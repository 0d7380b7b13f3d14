#pragma once

#include <cstdint>

#include "core/base/image_view.h"
#include "core/edges/dynamic_threshold.h"

namespace tubesight::core::edges {

/// The dark inside of a tube-end as the source's bisection finds it; full-frame pixels.
struct DarkRegion {
  bool found = false;
  std::int32_t left_q16 = 0;
  std::int32_t right_q16 = 0;
  std::int32_t top_q16 = 0;
  std::int32_t bottom_q16 = 0;

  [[nodiscard]] std::int32_t center_u_q16() const { return left_q16 + (right_q16 - left_q16) / 2; }
  [[nodiscard]] std::int32_t center_v_q16() const { return top_q16 + (bottom_q16 - top_q16) / 2; }
  [[nodiscard]] std::int32_t width_q16() const { return right_q16 - left_q16; }
  [[nodiscard]] std::int32_t height_q16() const { return bottom_q16 - top_q16; }
};

/// Finds the dark region around a point by vertical and horizontal searches outwards, each
/// bisected, the vertical one done twice [Fallon 5.1.1, 6.2.1].
///
/// `u_px`, `v_px`: full-frame, within the dark. Searches go `reach_px` at most to each side and
/// stay within the field. They read every `reading_step_px`-th pixel or line: in a picture so much
/// larger the same rises, at the same cost. The threshold follows the edges found; each edge gets
/// two more tries at half the threshold, started nearer to the point. Not found when one of the
/// four edges is missing. Costs some 100 instructions a step walked.
[[nodiscard]] DarkRegion find_dark_region(const FieldView& field, std::int32_t u_px,
                                          std::int32_t v_px, std::int32_t reach_px,
                                          DynamicThreshold& threshold,
                                          std::int32_t reading_step_px = 1);

/// What a cross-hair shows.
struct CrossHair {
  std::int32_t mean = 0;  ///< grey value
  std::int32_t dark = 0;  ///< pixels of the sixteen that are at most `threshold`
  bool blank = false;     ///< one grey value alone, as no part of a camera's picture has but white
};

/// Looks at the 16-pixel cross-hair at a point: four pixels along each arm [Fallon 6.2], spaced so
/// that an arm spans `reach_u_px` and `reach_v_px`. Arms that leave the field are cut off at its
/// border.
[[nodiscard]] CrossHair look_at_cross_hair(const FieldView& field, std::int32_t u_px,
                                           std::int32_t v_px, std::int32_t reach_u_px,
                                           std::int32_t reach_v_px, std::int32_t threshold = 0);

/// Its mean alone.
[[nodiscard]] inline std::int32_t cross_hair_mean(const FieldView& field, std::int32_t u_px,
                                                  std::int32_t v_px, std::int32_t reach_u_px,
                                                  std::int32_t reach_v_px) {
  return look_at_cross_hair(field, u_px, v_px, reach_u_px, reach_v_px).mean;
}

}  // namespace tubesight::core::edges
