#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/calibration/base_pairs.h"
#include "core/math/small_matrix.h"

namespace tubesight::core::calibration {

/// How far the robot's kinematics are off from pair to pair, one sigma.
struct RobotScatter {
  double across_mm = 0.5;  ///< along each axis of the sheet
  double along_mm = 1.0;   ///< along its normal: arms sink
  double turn_rad = 1e-3;  ///< about each axis
};

/// What is taken to be so before any pair is seen: few pairs tell little of their own scatter, so
/// these sizes of a robot measured part by part [docs/kinematics.md] count as so many misses more.
inline constexpr RobotScatter kExpectedScatter{0.5, 1.0, 1e-3};
inline constexpr double kExpectedWeight = 4.0;
/// One sigma, about each axis across the tool, of how the robot's tool axis stands to the one that
/// vision found at the docked tool: the lean of X.
inline constexpr double kToolLean_rad = 1.5e-3;

/// A fit's unknowns: the base's position (mm) and its turn (a rotation vector in the sheet frame,
/// rad), then X: two leans and the turn about the tool's axis.
inline constexpr int kBaseUnknowns = 9;
using BaseCholesky = math::Cholesky<kBaseUnknowns>;

struct BaseFit {
  BasePose pose;
  RobotScatter scatter;
  /// Of the base alone, in the unknowns' order; rows that are known beforehand are 0.
  math::Matrix6d covariance = math::Matrix6d::Zero();
  double turn_sigma_rad = 0.0;  ///< of X about the tool's axis
  /// How much of the rows is left over by the unknowns.
  double redundancy = 0.0;
  BaseCholesky::Matrix information = BaseCholesky::Matrix::Zero();  ///< its lower triangle
  BaseCholesky factor;
};

/// Maximum likelihood from `start`: base and X by least squares, and the robot's scatter by
/// restricted maximum likelihood, one number each across, along and in turning. False: the pairs do
/// not tell the base. Some 0.1 ms a dozen of pairs.
[[nodiscard]] bool fit_base(const BasePairs& pairs, std::span<const std::int32_t> chosen,
                            const BaseKnowledge& knowledge, const BasePose& start, BaseFit& fit);

/// How far a pair is from a fit: sums of squares in variances that the misses must have, three
/// places and three turns, each near 3; the fit's own uncertainty is counted. `fitted`: the pair is
/// one of those that made the fit.
struct PairMiss {
  double place2 = 0.0;
  double turn2 = 0.0;
};
[[nodiscard]] PairMiss miss_of(const BasePair& pair, const BaseFit& fit,
                               const BaseKnowledge& knowledge, bool fitted);

/// The base's covariance if this pair, too, had been there. False: it is not told.
[[nodiscard]] bool covariance_with(const BaseFit& fit, const BasePair& pair,
                                   const BaseKnowledge& knowledge, math::Matrix6d& covariance);

/// Derivatives of T_sheet_tool's place, as the calibrated base tells it, by the base's six.
[[nodiscard]] Eigen::Matrix<double, 3, 6> place_slope(const BasePose& pose,
                                                      const Eigen::Vector3d& place_sheet_mm);

}  // namespace tubesight::core::calibration
