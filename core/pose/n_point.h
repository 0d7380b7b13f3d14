#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/transform.h"
#include "core/math/small_matrix.h"
#include "core/pose/point_pair.h"

namespace tubesight::core::pose {

/// How solve_n_point() works.
struct NPointOptions {
  bool free_focal_length = false;   ///< EFL is found too [Fallon 5.2.3, step 3]
  double focal_length_sigma = 0.0;  ///< relative, of the EFL given; 0: nothing is known of it
  bool robust = false;              ///< points far off are left out by Tukey's weights
  double outlier_sigmas = 4.685;    ///< where Tukey's function leaves nothing
  std::int32_t max_steps = 30;
};

/// The pose that fits n points best.
struct NPointPose {
  Transform<frames::Camera, frames::Sheet> T_camera_sheet;
  /// Of (tau, theta), camera frame: the true pose is (exp([theta]x) R, t + tau). By the pairs'
  /// sigma, not scaled by the residuals.
  math::Matrix6d covariance = math::Matrix6d::Zero();
  double focal_length_ratio = 1.0;  ///< EFL found over EFL given
  double focal_length_sigma = 0.0;  ///< of that ratio
  double chi_square = 0.0;          ///< weighted squares of the residuals, robust weights applied
  double rms = 0.0;                 ///< on the plane at unit distance, all points alike
  std::int32_t steps = 0;
  std::int32_t used = 0;  ///< points with at least half their weight
};

/// The projection of an object point and its derivatives, as solve_n_point() uses them.
struct PointProjection {
  Eigen::Vector2d plane = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 6> by_pose = Eigen::Matrix<double, 2, 6>::Zero();  ///< (tau, theta)
};

/// Projects `point_mm`; the perturbation is (exp([theta]x) R, t + tau), camera frame. For points in
/// front of the camera.
[[nodiscard]] PointProjection project_point(const Transform<frames::Camera, frames::Sheet>& T,
                                            const Eigen::Vector3d& point_mm);

/// Minimises the distances on the image plane over the spatial transform itself [Fallon eq. 5.39]
/// by Levenberg's and Marquardt's method on the rotation group, from `start`.
///
/// Object points of any shape. kBufferTooSmall: fewer than three pairs (four with EFL free);
/// kIllConditioned: they don't determine the pose; kOutOfRange: no pose with all points in front
/// of the camera was found.
[[nodiscard]] Result<NPointPose> solve_n_point(
    std::span<const PointPair> pairs, const Transform<frames::Camera, frames::Sheet>& start,
    const NPointOptions& options);

}  // namespace tubesight::core::pose
