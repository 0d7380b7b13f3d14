#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "core/base/static_vector.h"
#include "core/detection/ellipse.h"
#include "core/detection/lattice_growth.h"
#include "core/detection/lens_bend.h"

namespace tubesight::core::detection {

/// An element used to see how the picture shows the lattice nearby.
struct IndexedPoint {
  Eigen::Vector2d index = Eigen::Vector2d::Zero();  ///< column, row, from the place asked for
  Eigen::Vector2d place_px = Eigen::Vector2d::Zero();
  double weight = 1.0;  ///< what its place counts for: the inverse of its variance, to a factor
};

/// Elements that one local map is made from.
inline constexpr std::int32_t kMaxMapPoints = 49;
using MapPoints = StaticVector<IndexedPoint, kMaxMapPoints>;

/// How the picture shows the lattice's plane around one of its places: a homography from (column,
/// row), counted from the place, to pixels that the lens has not bent. What is left of its bending
/// over a few elements is little.
class LocalMap {
 public:
  /// Fits the map to elements nearby, by least squares. False: fewer than five, all in a line, or
  /// a plane that is seen from its edge.
  [[nodiscard]] bool fit(std::span<const IndexedPoint> points, const LensBend& lens);

  /// Where the picture shows a place; for places near those of the fit.
  [[nodiscard]] Eigen::Vector2d to_pixel(const Eigen::Vector2d& index) const;

  /// Pixels a step of column and of row at the place asked for.
  [[nodiscard]] Eigen::Matrix2d slope() const;

  /// The ellipse that an element at the place asked for shows as, by the lattice's steps in radii.
  [[nodiscard]] Ellipse element(const Steps& steps) const;

  /// The image of a circle's centre that shows as this ellipse: the pole of the line in which the
  /// plane vanishes.
  [[nodiscard]] Eigen::Vector2d center_of(const Ellipse& ellipse) const;

  /// The length of the shorter step in the picture at the place asked for.
  [[nodiscard]] double shorter_step_px() const;

 private:
  LensBend lens_;
  Eigen::Matrix3d map_ = Eigen::Matrix3d::Identity();  ///< from (column, row) to scaled pixels
  Eigen::Vector2d origin_px_ = Eigen::Vector2d::Zero();
  double scale_px_ = 1.0;
};

}  // namespace tubesight::core::detection
