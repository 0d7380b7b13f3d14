#pragma once

#include "core/base/result.h"
#include "core/pose/conic.h"

namespace tubesight::core::pose {

/// A line that touches two ellipses on the same side of the join of their centres.
struct Bitangent {
  Eigen::Vector2d on_first = Eigen::Vector2d::Zero();   ///< where it touches the first
  Eigen::Vector2d on_second = Eigen::Vector2d::Zero();  ///< and the second
  Eigen::Vector3d line = Eigen::Vector3d::Zero();       ///< l^T p = 0, normal of unit length
  int steps = 0;                                        ///< tangents drawn
};

/// The ellipse's point farthest out in a direction: the one whose tangent is across it.
[[nodiscard]] Eigen::Vector2d farthest_point(const Conic& conic, const Eigen::Vector2d& direction);

/// The outer bitangent on the left (`side` = 1) or right (-1) of the way from the first centre to
/// the second, found by walking tangent lines out [Fallon fig. 5.11]: the tangent from a point of
/// the first to the second, from its touching point back to the first, and so on.
///
/// Each tangent's error is the square of the one before, so five are enough. The source starts at
/// an axis; here it is the point farthest out to that side, which is closer.
/// kIllConditioned: the ellipses overlap, so that no tangent can be drawn.
[[nodiscard]] Result<Bitangent> walk_bitangent(const Conic& first, const Conic& second, int side);

}  // namespace tubesight::core::pose
