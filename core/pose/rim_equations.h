#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "core/base/transform.h"
#include "core/pose/plane_points.h"
#include "core/pose/pose_model.h"

namespace tubesight::core::pose {

/// What is known of tube-ends and edges before the fit, and how outliers are told.
struct RimBundleOptions {
  double radius_sigma_mm = 0.1;     ///< of a tube-end's radius about the nominal one
  double offset_sigma_px = 1.0;     ///< of the edge offset common to all rims (blooming)
  double center_sigma_mm = 0.01;    ///< of a tube-end's centre from the lattice, each of x and y
  bool center_sigma_fixed = false;  ///< false: a first guess, set by the picture with more tubes
  bool point_sigma_fixed = false;   ///< false: the points' sigma_px are scaled by the residuals
  double outlier_sigmas = 3.5;      ///< Tukey's limit is this times 1.34
  double least_point_px = 0.05;     ///< below this the scale of outlier rejection does not go
  double normal_cosine = 0.7;       ///< points whose measured normal is farther off are rejected
  std::int32_t min_points = 8;      ///< of a rim
  std::int32_t max_passes = 8;
};

/// The unknowns shared by all tube-ends: tau, theta, and the edge offset.
using SharedVector = Eigen::Matrix<double, 7, 1>;
using SharedMatrix = Eigen::Matrix<double, 7, 7>;

/// One tube-end in the fit.
struct RimState {
  bool used = true;
  Eigen::Vector2d center_mm = Eigen::Vector2d::Zero();        ///< by the lattice
  double radius_mm = 0.0;                                     ///< fitted
  Eigen::Vector2d displacement_mm = Eigen::Vector2d::Zero();  ///< fitted
  /// Sums over the points in the basis of rim_equations.cpp, the upper triangle counts.
  Eigen::Matrix<double, 7, 7> gram = Eigen::Matrix<double, 7, 7>::Zero();
  Eigen::Matrix<double, 7, 1> moment = Eigen::Matrix<double, 7, 1>::Zero();
  double square = 0.0;  ///< sum of weighted squares of the residuals
  double weight = 0.0;  ///< sum of robust weights: how many points it amounts to
  std::int32_t points = 0;
  // With the own unknowns (radius, displacement) eliminated:
  Eigen::Matrix3d own_covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d own_gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 7> own_by_shared = Eigen::Matrix<double, 3, 7>::Zero();
  Eigen::Matrix<double, 7, 7> shared_normal = Eigen::Matrix<double, 7, 7>::Zero();
  Eigen::Matrix<double, 7, 1> shared_moment = Eigen::Matrix<double, 7, 1>::Zero();
};

/// Where a fit of rims stands; see fit_rims() for what is fitted.
struct RimProblem {
  const PoseModel* model = nullptr;
  const RimBundleOptions* options = nullptr;
  Eigen::Matrix3d R_sheet_tool = Eigen::Matrix3d::Identity();
  Eigen::Vector3d tip_mm = Eigen::Vector3d::Zero();
  double offset_px = 0.0;
  std::size_t stride = 1;  ///< only every so many points of rims with many count
  double limit_px = 0.0;   ///< of Tukey's weights; 0: none yet
  double scale2 = 1.0;     ///< of the points' variances
  double center_sigma_mm = 0.01;
  double radius_sigma_mm = 0.1;

  /// The stride for a rim of so many points.
  [[nodiscard]] std::size_t stride_for(std::size_t points) const {
    constexpr std::size_t kMany = 30;
    return points >= kMany ? stride : 1;
  }
};

/// The camera in the sheet frame, as one pass over the points needs it.
struct Sight {
  Eigen::Matrix3d R_sheet_camera;
  Eigen::Vector3d origin_mm;  ///< projection point
};
[[nodiscard]] Sight sight_of(const RimProblem& problem);

/// One pass over the points of a rim: residuals, robust weights and sums. Some 100 operations a
/// point.
void accumulate(const RimProblem& problem, const Sight& sight, std::span<PlanePoint> points,
                RimState& rim);

/// One step of all unknowns from the sums of a pass.
struct RimStep {
  bool solved = false;
  SharedVector change = SharedVector::Zero();
  SharedMatrix covariance = SharedMatrix::Zero();
  double size2 = 0.0;  ///< in standard deviations, squared
};

/// Solves for the shared unknowns with each tube-end's own eliminated (Schur's complement), and
/// finds the spread of centres along with them, `rounds` times.
[[nodiscard]] RimStep solve_step(RimProblem& problem, std::span<RimState> rims, int rounds);

/// Moves the shared unknowns by `change` and each tube-end's own to their best for it.
void apply_step(RimProblem& problem, std::span<RimState> rims, const SharedVector& change);

}  // namespace tubesight::core::pose
