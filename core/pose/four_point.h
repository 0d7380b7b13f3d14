#pragma once

#include <array>

#include "core/base/result.h"
#include "core/base/transform.h"
#include "core/pose/point_pair.h"

namespace tubesight::core::pose {

/// A pose from four points by their distances along the rays.
struct FourPointPose {
  Transform<frames::Camera, frames::Sheet> T_camera_sheet;
  Eigen::Vector4d lengths_mm = Eigen::Vector4d::Zero();  ///< |R_0| .. |R_3|
  double objective_mm2 = 0.0;                            ///< [Fallon eq. 5.32] at the minimum
};

/// Minimises the sum of the squares of six distances' errors over four ray lengths
/// [Fallon eq. 5.32-5.38], for any four points and not a square alone.
///
/// Start: all solutions of each of the four triangles, the fourth point put where its ray passes
/// nearest to its place, the best of them [Fallon 5.2.2]; then Levenberg's and Marquardt's method.
/// Orientation and place from the widest triangle, as in [Fallon eq. 5.25-5.28].
/// kIllConditioned: all four on a line, or no triangle has a solution.
[[nodiscard]] Result<FourPointPose> solve_four_points(const std::array<PointPair, 4>& pairs);

}  // namespace tubesight::core::pose
