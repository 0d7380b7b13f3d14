#include "core/calibration/tip_uncertainty.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace tubesight::core::calibration {
namespace {

constexpr int kParameters = CameraValues::RowsAtCompileTime;
using OfCamera = Eigen::Matrix<double, 6, kParameters>;

/// What a sheet's pose, (theta, tau) in the camera frame, is worth: minus N^-1 J_p^T J_c, N being
/// J_p^T J_p, is how it answers to the camera's parameters; N^-1 its covariance by pixels' noise.
struct PoseAnswer {
  OfCamera by_camera = OfCamera::Zero();
  math::Matrix6d by_noise = math::Matrix6d::Zero();
  std::int32_t tubes = 0;
};

/// d pixel / d (theta, tau) and d pixel / d camera of a place in the camera frame, by central
/// differences; the turn is about the sheet's origin.
void derive(const Sensor& sensor, const CameraValues& camera, const Eigen::Vector3d& arm,
            const Eigen::Vector3d& place, Eigen::Matrix<double, 2, 6>& by_pose,
            Eigen::Matrix<double, 2, kParameters>& by_camera) {
  constexpr double kShift_mm = 1e-4;
  Eigen::Matrix<double, 2, 3> by_place;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d off = kShift_mm * Eigen::Vector3d::Unit(i);
    by_place.col(i) =
        (pixel_of(sensor, camera, place + off) - pixel_of(sensor, camera, place - off)) /
        (2.0 * kShift_mm);
  }
  for (int i = 0; i < 3; ++i) {
    by_pose.col(i) = by_place * Eigen::Vector3d::Unit(i).cross(arm);
    by_pose.col(3 + i) = by_place.col(i);
  }
  for (int i = 0; i < kParameters; ++i) {
    const double step = 1e-6 * std::max(1.0, std::abs(camera(i)));
    const CameraValues off = step * CameraValues::Unit(i);
    by_camera.col(i) =
        (pixel_of(sensor, camera + off, place) - pixel_of(sensor, camera - off, place)) /
        (2.0 * step);
  }
}

/// Of the sheet `gap_mm` above the tip; its origin is where the guidetube's axis meets it.
PoseAnswer answer_at(const Sensor& sensor, const CameraValues& camera,
                     const TipSituation& situation, double gap_mm) {
  constexpr int kReach = 12;  // tube-ends to each side: farther than any wide lens needs here
  constexpr double kEdge_px = 10.0;  // a tube-end has a size
  constexpr double kNearest_mm = 10.0;
  const Eigen::Matrix3d& R = situation.R_camera_tool;
  const Eigen::Vector3d origin = situation.tip_mm + gap_mm * R.col(2);
  PoseAnswer answer;
  math::Matrix6d normal = math::Matrix6d::Zero();
  OfCamera cross = OfCamera::Zero();
  for (int i = -kReach; i <= kReach; ++i) {
    for (int k = -kReach; k <= kReach; ++k) {
      const Eigen::Vector3d arm = situation.pitch_mm * (i * R.col(0) + k * R.col(1));
      const Eigen::Vector3d place = origin + arm;
      if (place.z() < kNearest_mm) {
        continue;
      }
      const Eigen::Vector2d pixel = pixel_of(sensor, camera, place);
      if (!(pixel.x() > kEdge_px && pixel.x() < sensor.width_px - kEdge_px &&
            pixel.y() > kEdge_px && pixel.y() < sensor.height_px - kEdge_px)) {
        continue;
      }
      Eigen::Matrix<double, 2, 6> by_pose;
      Eigen::Matrix<double, 2, kParameters> by_camera;
      derive(sensor, camera, arm, place, by_pose, by_camera);
      normal += by_pose.transpose() * by_pose;
      cross += by_pose.transpose() * by_camera;
      ++answer.tubes;
    }
  }
  math::Cholesky<6> factor;
  if (answer.tubes < 4 || !factor.factor(normal)) {
    answer.tubes = 0;
    return answer;
  }
  answer.by_noise = factor.inverse();
  answer.by_camera = -answer.by_noise * cross;
  return answer;
}

Eigen::Matrix3d crossing(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

}  // namespace

TipUncertainty tip_uncertainty(const Sensor& sensor, const CameraValues& camera,
                               const math::Matrix6d& covariance, const TipSituation& situation,
                               double gap_mm) {
  TipUncertainty result;
  const PoseAnswer docked = answer_at(sensor, camera, situation, 0.0);
  const PoseAnswer now = answer_at(sensor, camera, situation, gap_mm);
  result.tubes = std::min(docked.tubes, now.tubes);
  if (!result.told()) {
    return result;
  }
  // Docked, the tip is the sheet's origin: it errs by tau_d. On the sheet now it is R^T (tip - t):
  // that error, less theta x (tip - t) + tau. All in the tool's directions.
  const Eigen::Matrix3d& R = situation.R_camera_tool;
  Eigen::Matrix<double, 3, 6> of_docked;
  of_docked << Eigen::Matrix3d::Zero(), Eigen::Matrix3d(R.transpose());
  Eigen::Matrix<double, 3, 6> of_now;
  of_now << crossing(Eigen::Vector3d(-gap_mm * R.col(2))), -Eigen::Matrix3d::Identity();
  of_now = (R.transpose() * of_now).eval();
  const Eigen::Matrix<double, 3, kParameters> by_camera =
      of_docked * docked.by_camera + of_now * now.by_camera;
  const Eigen::Matrix3d calibrated = by_camera * covariance * by_camera.transpose();
  const Eigen::Matrix3d all =
      calibrated + situation.tube_px * situation.tube_px *
                       (of_docked * docked.by_noise * of_docked.transpose() +
                        of_now * now.by_noise * of_now.transpose());
  result.across_mm = std::sqrt(std::max(calibrated(0, 0), calibrated(1, 1)));
  result.along_mm = std::sqrt(calibrated(2, 2));
  result.all_across_mm = std::sqrt(std::max(all(0, 0), all(1, 1)));
  result.all_along_mm = std::sqrt(all(2, 2));
  return result;
}

}  // namespace tubesight::core::calibration
