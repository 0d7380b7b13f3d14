#include "core/pose/center_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/pose/ellipse_fit.h"
#include "core/pose/n_point.h"
#include "core/pose/tool_answer.h"

namespace tubesight::core::pose {
namespace {

using CameraSheet = Transform<frames::Camera, frames::Sheet>;

constexpr int kMaxRounds = 12;
// Neighbours for constructions: the diagonal of a square pitch and a little.
constexpr double kReachSteps = 1.6;
// Below this a rim's own RMS does not make its centre more certain.
constexpr double kLeastRms_px = 0.02;

void find_circles(const PoseModel& model, const picture::RimList& rims, PlanePointBuffer& points,
                  CenterFitWorkspace& workspace) {
  workspace.count = 0;
  const double scale_px = model.camera.parameters().scale_px.x;
  for (std::int32_t i = 0; i < rims.size(); ++i) {
    const auto fit = fit_ellipse(points.of(i), {});
    if (!fit) {
      continue;
    }
    const std::size_t next = workspace.count++;
    workspace.circles[next] = {fit->conic, model.center_mm(rims[i].address)};
    workspace.rim[next] = i;
    workspace.sigma[next] =
        std::max(fit->rms_px, kLeastRms_px) * std::sqrt(2.0 / std::max(fit->points, 1)) / scale_px;
  }
}

void collect_pairs(const PoseModel& model, const CameraSheet& T, PoseMethod method,
                   CenterFitWorkspace& workspace) {
  workspace.pairs.clear();
  const std::span<const SeenCircle> circles(workspace.circles.data(), workspace.count);
  const double reach_mm = kReachSteps * model.lattice.parameters().shortest_step;
  for (std::size_t i = 0; i < workspace.count; ++i) {
    const SeenCircle& circle = circles[i];
    Eigen::Vector2d center = center_of(circle.conic);
    if (method == PoseMethod::kCenters) {
      const double radius = apparent_radius(T, circle, 0.5 * model.bore_mm);
      center += eccentricity(T, circle.center_mm, radius);
    } else if (method != PoseMethod::kEllipseCenters) {
      const auto made =
          construct_center(circles, i,
                           method == PoseMethod::kTangentLines ? CenterConstruction::kTangentLines
                                                               : CenterConstruction::kTangentPoints,
                           reach_mm);
      if (!made) {
        continue;
      }
      center = *made;
    }
    const Eigen::Vector3d object(circle.center_mm.x(), circle.center_mm.y(), 0.0);
    workspace.pair_circle[static_cast<std::size_t>(workspace.pairs.size())] =
        static_cast<std::int32_t>(i);
    static_cast<void>(workspace.pairs.try_push_back({object, center, workspace.sigma[i]}));
  }
}

RimFit as_fit(const PoseModel& model, const NPointPose& pose) {
  RimFit fit;
  fit.solved = true;
  fit.T_sheet_tool = tool_pose(pose.T_camera_sheet, model.T_camera_tool);
  const int freedom = 2 * pose.used - 6;
  const double scale2 = freedom > 0 ? std::max(pose.chi_square / freedom, 1.0) : 1.0;
  fit.covariance =
      scale2 * tool_covariance(pose.covariance, pose.T_camera_sheet, model.T_camera_tool);
  fit.rms_px = pose.rms * model.camera.parameters().scale_px.x;
  fit.point_scale = std::sqrt(scale2);
  fit.tubes = pose.used;
  fit.points = pose.used;
  return fit;
}

}  // namespace

RimFit fit_centers(const PoseModel& model, const picture::RimList& rims, const CameraSheet& start,
                   PoseMethod method, PlanePointBuffer& points, CenterFitWorkspace& workspace) {
  find_circles(model, rims, points, workspace);
  NPointOptions options;
  options.robust = true;
  CameraSheet T = start;
  const int rounds = method == PoseMethod::kCenters ? kMaxRounds : 1;
  NPointPose pose;
  for (int round = 0; round < rounds; ++round) {
    collect_pairs(model, T, method, workspace);
    const auto solved = solve_n_point(workspace.pairs.view(), T, options);
    if (!solved) {
      return {};
    }
    pose = *solved;
    const double change = (pose.T_camera_sheet.translation_mm() - T.translation_mm()).norm() +
                          100.0 * (pose.T_camera_sheet.rotation() - T.rotation()).norm();
    T = pose.T_camera_sheet;
    if (change < 1e-8) {
      break;
    }
  }
  return as_fit(model, pose);
}

}  // namespace tubesight::core::pose
