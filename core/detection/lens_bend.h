#pragma once

#include <span>

#include <Eigen/Core>

#include "core/detection/ellipse.h"

namespace tubesight::core::detection {

struct IndexedPoint;

/// How far the lens has bent what a picture shows, all that its lattice's straight rows tell of it:
/// a shift along the radius from the picture's middle, by a share that grows with its square.
class LensBend {
 public:
  LensBend() = default;
  LensBend(const Eigen::Vector2d& middle_px, double per_px2)
      : middle_px_(middle_px), per_px2_(per_px2) {}

  /// Where a place of the picture would be without.
  [[nodiscard]] Eigen::Vector2d straight(const Eigen::Vector2d& bent_px) const {
    const Eigen::Vector2d off = bent_px - middle_px_;
    return bent_px + per_px2_ * off.squaredNorm() * off;
  }
  [[nodiscard]] Ellipse straight(const Ellipse& bent) const;

  /// The reverse.
  [[nodiscard]] Eigen::Vector2d bent(const Eigen::Vector2d& straight_px) const;
  [[nodiscard]] Ellipse bent(const Ellipse& straight) const;

 private:
  /// What straight() makes of a small step from a place.
  [[nodiscard]] Eigen::Matrix2d slope_at(const Eigen::Vector2d& bent_px) const;
  /// How far the middle of an ellipse's outline is then from its centre's own image.
  [[nodiscard]] Eigen::Vector2d shift_of(const Ellipse& bent) const;

  Eigen::Vector2d middle_px_ = Eigen::Vector2d::Zero();
  double per_px2_ = 0.0;
};

/// The bending that leaves the elements nearest to one homography from their indices; none where
/// they are few or do not tell. `size_px`: of the picture.
[[nodiscard]] LensBend find_bend(std::span<const IndexedPoint> points,
                                 const Eigen::Vector2d& size_px);

}  // namespace tubesight::core::detection
