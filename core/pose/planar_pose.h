#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/result.h"
#include "core/base/transform.h"
#include "core/pose/point_pair.h"

namespace tubesight::core::pose {

/// A pose that a closed form proposes.
struct PoseCandidate {
  Transform<frames::Camera, frames::Sheet> T_camera_sheet;
  double rms = 0.0;  ///< of the points' distances on the plane at unit distance
};

/// Both poses that a plane's perspective leaves open, the better one first.
struct PlanarPoses {
  std::array<PoseCandidate, 2> candidates;
};

/// The homography from a plane's points (object x, y shifted by `origin` and times `scale`) to the
/// image plane, lower right element 1, by linear least squares [Hartley2004 sec. 4.1].
struct Homography {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  Eigen::Vector2d origin_mm = Eigen::Vector2d::Zero();
  double scale_per_mm = 1.0;
};

/// kBufferTooSmall: fewer than four pairs; kIllConditioned: too many on one line.
[[nodiscard]] Result<Homography> fit_homography(std::span<const PointPair> pairs);

/// The poses of a plane (object z = 0) by its homography at the points' middle, both solutions: the
/// plane leaning one way or the other about the line of sight [Collins2014 sec. 3.2].
///
/// Errors are those of fit_homography(). Some 100 operations a pair.
[[nodiscard]] Result<PlanarPoses> planar_poses(std::span<const PointPair> pairs);

/// The translation that fits a given rotation best, by linear least squares of the cross-multiplied
/// projection; kIllConditioned when the points don't determine it.
[[nodiscard]] Result<Eigen::Vector3d> translation_for(const Eigen::Matrix3d& R_camera_sheet,
                                                      std::span<const PointPair> pairs);

/// Root mean square of the pairs' distances on the image plane; huge when a point lies behind.
[[nodiscard]] double plane_rms(const Transform<frames::Camera, frames::Sheet>& T_camera_sheet,
                               std::span<const PointPair> pairs);

}  // namespace tubesight::core::pose
