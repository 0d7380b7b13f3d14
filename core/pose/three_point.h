#pragma once

#include <array>

#include "core/base/static_vector.h"
#include "core/base/transform.h"
#include "core/pose/point_pair.h"

namespace tubesight::core::pose {

/// Distances of three object points along their rays, mm.
using RayLengths = Eigen::Vector3d;

/// All real, positive lengths x_0, x_1, x_2 for which three rays hold a triangle of known sides:
/// the three laws of cosines [Fallon eq. 5.22-5.24], reduced to a quartic in x_1 / x_0
/// [Haralick1991, Grunert's solution] and polished by Newton's method on the three equations.
///
/// `rays`: unit vectors; `sides_mm`: d_01, d_02, d_12. Four solutions at most, usually two.
[[nodiscard]] StaticVector<RayLengths, 4> solve_ray_lengths(
    const std::array<Eigen::Vector3d, 3>& rays, const std::array<double, 3>& sides_mm);

/// The triangle's own frame: x along side 1-2, z along side 1-2 times side 1-0
/// [Fallon eq. 5.25-5.28]. For points that are not on one line.
[[nodiscard]] Eigen::Matrix3d triangle_axes(const std::array<Eigen::Vector3d, 3>& points);

/// The poses of three object points: all real solutions. None for points on one line.
[[nodiscard]] StaticVector<Transform<frames::Camera, frames::Sheet>, 4> solve_three_points(
    const std::array<PointPair, 3>& pairs);

}  // namespace tubesight::core::pose
