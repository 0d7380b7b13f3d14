#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "core/base/static_vector.h"
#include "core/picture/rim.h"
#include "core/picture/sheet_view.h"

namespace tubesight::core::picture {

/// A short piece of a rim's predicted image.
struct OutlineArc {
  double u_px = 0.0;  ///< its middle
  double v_px = 0.0;
  double normal_u = 0.0;  ///< unit vector outwards, from the tube-end into the sheet
  double normal_v = 0.0;
  double half_length_px = 0.0;
  /// The image of the rim near the middle: y = slope x + bend x^2, x along the tangent
  /// (-normal_v, normal_u), y along the normal.
  double slope = 0.0;
  double bend = 0.0;
};

/// The predicted image of one rim, all around, also where it lies outside the picture.
struct RimOutline {
  StaticVector<OutlineArc, kMaxRimPoints> arcs;
  double center_u_px = 0.0;  ///< image of the circle's centre
  double center_v_px = 0.0;
  double half_width_px = 0.0;   ///< half the smallest extent along u
  double half_height_px = 0.0;  ///< and along v
};

/// Projects the circle of a tube-end in pieces of `arc_px` or, for large rims, of a 128th of it.
/// False when a part of it has no image.
[[nodiscard]] bool project_rim(const SheetView& view, const Eigen::Vector2d& center_mm,
                               double radius_mm, double arc_px, RimOutline& outline);

/// The outline through points of a rim's image, in their order around it and at most kMaxRimPoints
/// of them; a piece's middle is a point, its ends lie half way to the next ones.
void outline_through(std::span<const Eigen::Vector2d> points, const Eigen::Vector2d& center,
                     RimOutline& outline);

}  // namespace tubesight::core::picture
