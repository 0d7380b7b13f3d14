#include "core/verification/position_correction.h"

#include <cmath>

#include <Eigen/Geometry>

#include "core/math/rotation.h"
#include "core/pose/tool_answer.h"

namespace tubesight::core::verification {
namespace {

using math::exp_rotation;
using math::log_rotation;
using math::Matrix6d;
using math::skew;
using pose::offset_from;
using pose::PoseModel;
using pose::TubeOffset;

using SheetTool = Transform<frames::Sheet, frames::Tool>;

// The square root of a symmetric matrix's larger eigenvalue.
double larger_deviation(const Eigen::Matrix2d& covariance) {
  const double mean = 0.5 * covariance.trace();
  const double half = 0.5 * (covariance(0, 0) - covariance(1, 1));
  return std::sqrt(mean + std::sqrt(half * half + covariance(0, 1) * covariance(0, 1)));
}

// The turn that takes the axis to the sheet's normal by the shortest way: no heading is added.
Eigen::Matrix3d squaring_turn(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d across = axis.cross(Eigen::Vector3d::UnitZ());
  const double sine = across.norm();
  if (sine < 1e-12) {
    return Eigen::Matrix3d::Identity();
  }
  return exp_rotation(across * (std::atan2(sine, axis.z()) / sine));
}

SheetTool goal_pose(const PoseModel& model, const SheetTool& now,
                    const CorrectionRequest& request) {
  const Eigen::Vector2d center = model.center_mm(request.tube);
  const double z = now.translation_mm().z();
  Eigen::Matrix3d R = now.rotation();
  Eigen::Vector3d tip(center.x(), center.y(), z);
  if (request.goal == CorrectionGoal::kSquaredUp) {
    R = squaring_turn(R.col(2)) * R;
  } else if (request.goal == CorrectionGoal::kAxisThrough) {
    tip.head<2>() += R.col(2).head<2>() * (z / R(2, 2));
  }
  return {R, tip};
}

Eigen::Matrix2d lateral(const Eigen::Matrix<double, 2, 6>& J, const Matrix6d& covariance) {
  const Eigen::Matrix<double, 2, 6> half = J.lazyProduct(covariance);
  return half.lazyProduct(J.transpose());
}

}  // namespace

Eigen::Matrix2d axis_covariance(const SheetTool& T_sheet_tool, const Matrix6d& covariance) {
  const Eigen::Vector3d n = T_sheet_tool.rotation().col(2);
  const double length = -T_sheet_tool.translation_mm().z() / n.z();
  Eigen::Matrix3d M = Eigen::Matrix3d::Identity();
  M.col(2) -= n / n.z();
  Eigen::Matrix<double, 2, 6> J;
  J.leftCols<3>() = M.topRows<2>();
  J.rightCols<3>() = -length * (M * skew(n)).topRows<2>();
  return lateral(J, covariance);
}

PositionCorrection correct_position(const PoseModel& model, const SheetTool& T_sheet_tool,
                                    const Matrix6d& covariance, const CorrectionRequest& request) {
  PositionCorrection result;
  const SheetTool goal = goal_pose(model, T_sheet_tool, request);
  const auto back = T_sheet_tool.inverse();
  result.move = back * goal;
  result.distance_mm = result.move.translation_mm().norm();
  result.turn_rad = log_rotation(result.move.rotation()).norm();

  const Eigen::Matrix2d tube =
      request.tube_sigma_mm * request.tube_sigma_mm * Eigen::Matrix2d::Identity();
  const TubeOffset offset = offset_from(model, T_sheet_tool, request.tube);
  result.offset_mm = offset.distance_mm;
  result.offset_bound_mm =
      result.offset_mm +
      request.sigmas * larger_deviation(axis_covariance(T_sheet_tool, covariance) + tube);
  result.met_now = result.offset_bound_mm <= request.limit_mm;

  // The pose's error at the moved tip, or where the moved axis meets the sheet.
  const Eigen::Vector3d moved = T_sheet_tool.rotation() * result.move.translation_mm();
  Matrix6d J = Matrix6d::Identity();
  J.topRightCorner<3, 3>() = -skew(moved);
  const Matrix6d half = J.lazyProduct(covariance);
  const Matrix6d at_goal = half.lazyProduct(J.transpose());
  result.left_covariance = request.goal == CorrectionGoal::kTipUnder
                               ? Eigen::Matrix2d(at_goal.topLeftCorner<2, 2>())
                               : axis_covariance(goal, at_goal);
  result.left_covariance +=
      tube + request.move_sigma_mm * request.move_sigma_mm * Eigen::Matrix2d::Identity();
  result.left_mm = request.sigmas * larger_deviation(result.left_covariance);
  result.met_after = result.left_mm <= request.limit_mm;
  return result;
}

}  // namespace tubesight::core::verification
