#pragma once

#include <cstdint>

#include "core/base/transform.h"
#include "core/base/tube_address.h"
#include "core/math/small_matrix.h"
#include "core/pose/pose_model.h"

namespace tubesight::core::verification {

/// What a correction brings about.
enum class CorrectionGoal : std::uint8_t {
  kTipUnder,     ///< tip below the tube's centre at the height it has; the lean stays
  kAxisThrough,  ///< guidetube's axis through the tube's centre, height and lean stay
  kSquaredUp,    ///< axis along the sheet's normal through the tube's centre, height stays
};

/// Limits that insertions have.
inline constexpr double kProbeLimit_mm = 2.5;     ///< 2 to 3 mm for an eddy-current probe
inline constexpr double kPlugToolLimit_mm = 0.5;  ///< for a plug tool

/// What is asked for.
struct CorrectionRequest {
  TubeAddress tube;
  CorrectionGoal goal = CorrectionGoal::kTipUnder;
  double limit_mm = kProbeLimit_mm;  ///< of the offset at which the insertion works
  double move_sigma_mm = 0.0;        ///< of the robot's own error in such a move, each direction
  double tube_sigma_mm = 0.0;        ///< of the tube's centre from the lattice, each of x and y
  double sigmas = 3.035;             ///< how sure: 99 % of a normal error in two directions
};

/// The move and what it is worth.
struct PositionCorrection {
  /// T_tool_moved: the tool's frame after the move, seen from the tool's frame before it. The
  /// translation is the move of the tip in the tool's own axes.
  Transform<frames::Tool, frames::Tool> move;
  double distance_mm = 0.0;  ///< of the tip's move
  double turn_rad = 0.0;     ///< of the tool's turn
  /// Of the offset that is left after the move, sheet x and y, mm^2.
  Eigen::Matrix2d left_covariance = Eigen::Matrix2d::Zero();
  double left_mm = 0.0;          ///< `sigmas` of the larger axis of that
  double offset_mm = 0.0;        ///< of the axis at the sheet now, from the tube's centre
  double offset_bound_mm = 0.0;  ///< that with `sigmas` of its deviation added
  bool met_now = false;          ///< offset_bound_mm <= limit
  bool met_after = false;        ///< left_mm <= limit
};

/// The move in the tool's frame that brings the tool under a tube, from a measured pose.
///
/// `covariance` as in PoseEstimate. The move is made in the tool's frame as it truly is, so the
/// errors left are those of the pose at the moved tip: tau + theta x (R t_move).
[[nodiscard]] PositionCorrection correct_position(
    const pose::PoseModel& model, const Transform<frames::Sheet, frames::Tool>& T_sheet_tool,
    const math::Matrix6d& covariance, const CorrectionRequest& request);

/// The covariance of the point where the axis meets the sheet: delta a = M (tau + l theta x n) with
/// n the axis, l = -z / n_z its length to the sheet and M = I - n e_z^T / n_z.
[[nodiscard]] Eigen::Matrix2d axis_covariance(
    const Transform<frames::Sheet, frames::Tool>& T_sheet_tool, const math::Matrix6d& covariance);

}  // namespace tubesight::core::verification
