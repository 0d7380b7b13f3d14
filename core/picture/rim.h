#pragma once

#include <cstdint>

#include "core/base/sighting.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"

namespace tubesight::core::picture {

/// Points that one rim holds. A rim that fills the picture's height has a circumference of some
/// 1500 px; points closer than the blur repeat each other, and 128 of them place a centre to a
/// hundredth of what a tube-end's own pitch error is.
inline constexpr std::int32_t kMaxRimPoints = 128;

/// One point of a tube-end's edge to a fraction of a pixel, as the picture shows it.
struct RimPoint {
  double u_px = 0.0;  ///< full-frame pixels, distortion left in
  double v_px = 0.0;
  double normal_u = 0.0;  ///< unit vector across the edge, from the dark outwards, in the picture;
  double normal_v = 0.0;  ///< both zero: not measured, the point is not tested against it
  double sigma_px = 0.1;  ///< standard deviation across the edge
};

/// The edge of one tube-end: an arc of it, or all of it, in no particular order.
struct Rim {
  TubeAddress address;
  StaticVector<RimPoint, kMaxRimPoints> points;
};

/// All rims of one picture. 0.5 MB: static or in a workspace, never on a stack.
using RimList = StaticVector<Rim, kMaxTubesInView>;

}  // namespace tubesight::core::picture
