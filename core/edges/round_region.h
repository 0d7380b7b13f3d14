#pragma once

#include <cstdint>

#include "core/base/image_view.h"

namespace tubesight::core::edges {

/// How a circle of the tubesheet lies in the picture around a place: its point at the angle t is
/// `radius` (along cos t + across sin t) from its centre. Both in 1/65536 px of the full frame for
/// a radius of one step; the longer one is as long as readings are apart.
struct CircleShape {
  std::int32_t along_u_q16 = 65536;
  std::int32_t along_v_q16 = 0;
  std::int32_t across_u_q16 = 0;
  std::int32_t across_v_q16 = 65536;
};

/// A dark circle of the sheet; full-frame pixels, grey levels on both sides of its rim.
struct RoundRegion {
  bool found = false;
  std::int32_t center_u_q16 = 0;
  std::int32_t center_v_q16 = 0;
  std::int32_t width_q16 = 0;  ///< of its image
  std::int32_t height_q16 = 0;
  std::int32_t inside = 0;
  std::int32_t outside = 0;
};

/// Finds the dark circle that holds a place by looking outwards in 24 directions.
///
/// Each reading is the median of the nine pixels around it, so that specks and single dark pixels
/// count for nothing. Each direction gives up to three rises from dark to bright, and the circle is
/// that on which rises of the most directions lie, 13 at least, with dark from the place to them:
/// blots, lamp spots and ghosts may spoil the others. `u_px`, `v_px`: full-frame, up to 80 % of the
/// radius off its centre. The centre is right to some two pixels. Looks `reach` steps far, 160 at
/// most. Costs some 1.1 million instructions with a reach of 80, twice as many with 160.
[[nodiscard]] RoundRegion find_round_region(const FieldView& field, std::int32_t u_px,
                                            std::int32_t v_px, const CircleShape& shape,
                                            std::int32_t reach);

}  // namespace tubesight::core::edges
