#include "core/calibration/docking_focal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/base/assert.h"
#include "core/camera/camera_setup.h"
#include "core/math/rotation.h"
#include "core/pose/calibration_uncertainty.h"
#include "core/pose/center_fit.h"
#include "core/pose/n_point.h"
#include "core/pose/plane_points.h"

namespace tubesight::core::calibration {
namespace {

using pose::CameraParameter;

/// Steps for derivatives: small against what moves the EFL, large against rounding.
constexpr std::array<double, 6> kSteps = {0.01, 1e-4, 0.1, 0.1, 1e-5, 1e-6};

/// The EFL and its deviation with a camera, from the pose of `estimate`.
bool solve(const pose::PoseModel& model, const picture::RimList& rims,
           const pose::PoseEstimate& estimate, pose::PoseWorkspace& workspace,
           DockingFocal& result) {
  pose::to_plane_points(model.camera, rims, workspace.points);
  const pose::RimFit centers =
      pose::fit_centers(model, rims, estimate.T_camera_sheet, pose::PoseMethod::kCenters,
                        workspace.points, workspace.centers);
  if (!centers.solved) {
    return false;
  }
  pose::PointPairList& pairs = workspace.centers.pairs;
  for (pose::PointPair& pair : pairs) {
    const double depth_mm = (estimate.T_camera_sheet * pair.object_mm).z();
    pair.sigma = std::hypot(pair.sigma, estimate.center_sigma_mm / std::max(depth_mm, 1.0));
  }
  pose::NPointOptions options;
  options.free_focal_length = true;
  options.robust = true;
  const auto pose = pose::solve_n_point(pairs.view(), estimate.T_camera_sheet, options);
  if (!pose) {
    return false;
  }
  const int freedom = 2 * pose->used - 7;
  if (freedom < 1) {
    return false;  // nothing tells how good it is
  }
  const double scale = std::sqrt(std::max(pose->chi_square / freedom, 1.0));
  const double given_mm = model.camera_settings.focal_length_mm;
  result.focal_length_mm = pose->focal_length_ratio * given_mm;
  result.sigma_mm = scale * pose->focal_length_sigma * given_mm;
  return std::isfinite(result.focal_length_mm) && std::isfinite(result.sigma_mm);
}

}  // namespace

DockingFocal focal_by_docking(const pose::PoseModel& model, const picture::RimList& rims,
                              const pose::PoseEstimate& estimate, pose::PoseWorkspace& workspace) {
  DockingFocal result;
  result.solved = solve(model, rims, estimate, workspace, result);
  for (std::size_t i = 1; result.solved && i < kSteps.size(); ++i) {
    std::array<double, 2> found{};
    for (const std::size_t side : {0U, 1U}) {
      pose::PoseModel changed = model;
      pose::change_parameter(changed.camera_settings, static_cast<CameraParameter>(i),
                             side == 0 ? -kSteps[i] : kSteps[i]);
      const auto camera = camera::make_camera_model<double>(changed.camera_settings);
      DockingFocal moved;
      if (!camera) {
        result.solved = false;
        break;
      }
      changed.camera = *camera;
      if (!solve(changed, rims, estimate, workspace, moved)) {
        result.solved = false;
        break;
      }
      found[side] = moved.focal_length_mm;
    }
    result.by_camera(static_cast<Eigen::Index>(i)) = (found[1] - found[0]) / (2.0 * kSteps[i]);
  }
  return result;
}

DockingFocal combined_focal(std::span<const DockingFocal> dockings) {
  TUBESIGHT_ASSERT(!dockings.empty());
  DockingFocal result;
  double weights = 0.0;
  for (const DockingFocal& docking : dockings) {
    const double weight = 1.0 / std::max(docking.sigma_mm * docking.sigma_mm, 1e-18);
    weights += weight;
    result.focal_length_mm += weight * docking.focal_length_mm;
    result.by_camera += weight * docking.by_camera;
  }
  result.focal_length_mm /= weights;
  result.by_camera /= weights;
  double square = 0.0;
  for (const DockingFocal& docking : dockings) {
    const double off = (docking.focal_length_mm - result.focal_length_mm) / docking.sigma_mm;
    square += off * off;
  }
  const double freedom = std::max<double>(1.0, static_cast<double>(dockings.size()) - 1.0);
  result.sigma_mm = std::sqrt(std::max(1.0, square / freedom) / weights);
  result.solved = true;
  return result;
}

FocalWalk::Step FocalWalk::take(const DockingFocal& found, double with_mm) {
  constexpr double kStays = 0.05;  // of a standard deviation
  // Where tube-ends at the edge of what is taken come and go with it, the EFL goes to and fro.
  constexpr double kTrembles = 0.5;
  if (!(std::abs(found.focal_length_mm / type_mm_ - 1.0) < kMostChange)) {
    return Step::kElsewhere;
  }
  change_mm_ = std::abs(found.focal_length_mm - with_mm);
  if (change_mm_ < kStays * found.sigma_mm) {
    return Step::kSettled;
  }
  if (++steps_ < kMostSteps) {
    return Step::kGoOn;
  }
  return change_mm_ < kTrembles * found.sigma_mm ? Step::kSettled : Step::kRestless;
}

math::Matrix6d camera_covariance(const DockingFocal& focal, const math::Matrix6d& covariance) {
  math::Matrix6d result = covariance;
  result.row(0).setZero();
  result.col(0).setZero();
  // f = f(p) and the errors of p are e: that of f is by_camera . e, beside its own.
  const math::Vector6d cross = result.lazyProduct(focal.by_camera);
  const double carried = focal.by_camera.dot(cross);
  result.col(0) = cross;
  result.row(0) = cross.transpose();
  result(0, 0) = focal.sigma_mm * focal.sigma_mm + carried;
  return result;
}

MapUncertainty map_beside_turn(const Sensor& sensor, const CameraValues& camera,
                               const math::Matrix6d& covariance) {
  constexpr std::int32_t kColumns = 17;
  constexpr std::int32_t kRows = 13;
  using Slope = Eigen::Matrix<double, 2, 6>;
  using Turn = Eigen::Matrix<double, 2, 3>;
  const auto pixel_at = [&](std::int32_t i) {
    return Eigen::Vector2d((i % kColumns) * (sensor.width_px - 1.0) / (kColumns - 1),
                           (i / kColumns) * (sensor.height_px - 1.0) / (kRows - 1));
  };
  const Eigen::Vector2d scale(camera(0) * camera(1) / sensor.column_mm, camera(0) / sensor.row_mm);
  const auto slope_at = [&](const Eigen::Vector2d& pixel) {
    Slope slope;
    for (int k = 0; k < 6; ++k) {
      const double step = 1e-6 * std::max(1.0, std::abs(camera(k)));
      const CameraValues off = step * CameraValues::Unit(k);
      slope.col(k) = scale.cwiseProduct(ideal_of(sensor, camera + off, pixel) / (camera + off)(0) -
                                        ideal_of(sensor, camera - off, pixel) / (camera - off)(0)) /
                     (2.0 * step);
    }
    return slope;
  };
  // A turn theta moves the ray (x, y, 1) by theta x (x, y, 1), and its place on the plane by that
  // less (x, y) times its third part.
  const auto turn_at = [&](const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d p = ideal_of(sensor, camera, pixel) / camera(0);
    Turn turn;
    turn << -p.x() * p.y(), 1.0 + p.x() * p.x(), -p.y(), -1.0 - p.y() * p.y(), p.x() * p.y(), p.x();
    turn.row(0) *= scale.x();
    turn.row(1) *= scale.y();
    return turn;
  };
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 6> right = Eigen::Matrix<double, 3, 6>::Zero();
  for (std::int32_t i = 0; i < kColumns * kRows; ++i) {
    const Turn turn = turn_at(pixel_at(i));
    normal += turn.transpose() * turn;
    right += turn.transpose() * slope_at(pixel_at(i));
  }
  math::Cholesky<3> factor;
  const bool factored = factor.factor(normal);
  TUBESIGHT_ASSERT(factored);  // the pixels of a picture tell three turns apart
  const Eigen::Matrix<double, 3, 6> made_up = factor.inverse() * right;
  MapUncertainty result;
  double squares = 0.0;
  for (std::int32_t i = 0; i < kColumns * kRows; ++i) {
    const Eigen::Vector2d pixel = pixel_at(i);
    const Slope left = slope_at(pixel) - turn_at(pixel) * made_up;
    const double variance = (left * covariance * left.transpose()).trace();
    squares += variance;
    if (std::sqrt(variance) > result.worst_px) {
      result.worst_px = std::sqrt(variance);
      result.worst_u_px = pixel.x();
      result.worst_v_px = pixel.y();
    }
  }
  result.rms_px = std::sqrt(squares / (kColumns * kRows));
  return result;
}

math::Vector6d tool_by_focal(const DockingList& dockings, std::span<const math::Vector6d> by_focal,
                             const DockingAssumption& assumption) {
  constexpr double kStep_mm = 0.001;
  const auto moved = [&](double by_mm) {
    DockingList list = dockings;
    for (std::int32_t i = 0; i < list.size(); ++i) {
      const math::Vector6d change = by_mm * by_focal[static_cast<std::size_t>(i)];
      auto& T = list[i].T_sheet_camera;
      const Eigen::Vector3d turn = change.tail<3>();
      const Eigen::Matrix3d rotation = math::exp_rotation(turn) * T.rotation();
      T = {rotation, T.translation_mm() + change.head<3>()};
    }
    return calibrate_tool(list, assumption).values;
  };
  return (moved(kStep_mm) - moved(-kStep_mm)) / (2.0 * kStep_mm);
}

}  // namespace tubesight::core::calibration
