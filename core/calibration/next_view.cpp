#include "core/calibration/next_view.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace tubesight::core::calibration {
namespace {

constexpr double kTilt_rad = 0.5235987755982988;  // 30 degrees: 20 to 40 tell most of EFL

Eigen::Matrix3d tilt_of(NextView view) {
  const auto turn = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  switch (view) {
    case NextView::kUpperNearer: return turn(kTilt_rad, Eigen::Vector3d::UnitX());
    case NextView::kLowerNearer: return turn(-kTilt_rad, Eigen::Vector3d::UnitX());
    case NextView::kLeftNearer: return turn(-kTilt_rad, Eigen::Vector3d::UnitY());
    case NextView::kRightNearer: return turn(kTilt_rad, Eigen::Vector3d::UnitY());
    case NextView::kSquare: break;
  }
  return Eigen::Matrix3d::Identity();
}

/// The dots of the first view and where they stand in the middle of the others' distances.
class Template {
 public:
  Template(const CalibrationData& data, const CalibrationState& state)
      : data_(data), first_(data.views[0]) {
    for (std::int32_t i = first_.first; i < first_.first + first_.count; ++i) {
      middle_mm_ += data.dots[i].place_mm / first_.count;
    }
    for (const TargetPose& pose : state.poses) {
      away_mm_ +=
          (pose.R_camera_target * middle_mm_ + pose.t_camera_target).z() / state.poses.size();
    }
    const Eigen::Matrix3d& turned = state.poses[0].R_camera_target;
    in_plane_ = Eigen::AngleAxisd(std::atan2(turned(1, 0), turned(0, 0)), Eigen::Vector3d::UnitZ());
  }

  /// Its pose in the next view: in the picture's middle, or half the way to the place least known.
  [[nodiscard]] TargetPose pose_in(NextView view, const CalibrationState& state,
                                   const MapUncertainty& map) const {
    TargetPose pose;
    pose.R_camera_target = tilt_of(view) * in_plane_;
    Eigen::Vector2d aim = 0.5 * Eigen::Vector2d(data_.sensor.width_px, data_.sensor.height_px);
    if (view == NextView::kSquare) {
      aim = 0.5 * (aim + Eigen::Vector2d(map.worst_u_px, map.worst_v_px));
    }
    const Eigen::Vector2d ray = ideal_of(data_.sensor, state.camera, aim) / state.camera(0);
    const Eigen::Vector3d middle = away_mm_ * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
    pose.t_camera_target = middle - pose.R_camera_target * middle_mm_;
    return pose;
  }

  /// Appends the view with the dots that are in the picture, each where it would be seen; false
  /// where there is no room.
  [[nodiscard]] bool append(const TargetPose& pose, const CalibrationState& state,
                            CalibrationData& data) const {
    CalibrationView view;
    view.first = data.dots.size();
    for (std::int32_t i = first_.first; i < first_.first + first_.count; ++i) {
      SeenDot dot;
      dot.place_mm = data_.dots[i].place_mm;
      const Eigen::Vector3d place = pose.R_camera_target * dot.place_mm + pose.t_camera_target;
      if (!(place.z() > 0.1 * away_mm_)) {
        continue;
      }
      dot.seen_px = centroid_of(data.sensor, state.camera, pose, dot.place_mm, data.dot_radius_mm);
      const bool in = dot.seen_px.x() > 0.0 && dot.seen_px.y() > 0.0 &&
                      dot.seen_px.x() < data.sensor.width_px - 1.0 &&
                      dot.seen_px.y() < data.sensor.height_px - 1.0;
      if (in && !data.dots.try_push_back(dot)) {
        return false;
      }
    }
    view.count = data.dots.size() - view.first;
    constexpr std::int32_t kLeast = 12;
    return view.count >= kLeast && data.views.try_push_back(view);
  }

 private:
  const CalibrationData& data_;
  const CalibrationView& first_;
  Eigen::Vector3d middle_mm_ = Eigen::Vector3d::Zero();
  double away_mm_ = 0.0;
  Eigen::Matrix3d in_plane_ = Eigen::Matrix3d::Identity();
};

}  // namespace

NextViewOutcome find_next_view(const CalibrationData& data, const CalibrationState& state,
                               const CalibrationOutcome& outcome, HalvesScratch& scratch) {
  NextViewOutcome best;
  FitOptions options = outcome.freed;
  options.tangential = false;  // the camera is the best one without it
  const Template seen(data, state);
  for (const NextView view : {NextView::kUpperNearer, NextView::kLowerNearer, NextView::kLeftNearer,
                              NextView::kRightNearer, NextView::kSquare}) {
    scratch.data = data;
    scratch.state = state;
    const TargetPose pose = seen.pose_in(view, state, outcome.map);
    if (!seen.append(pose, state, scratch.data) || !scratch.state.poses.try_push_back(pose)) {
      continue;
    }
    const FitOutcome fit = fit_camera(options, scratch.data, scratch.state, scratch.fit);
    if (!fit.determined || !(fit.sigma_px > 0.0)) {
      continue;
    }
    // The new dots have no noise yet: the noise is that of the old ones, and their pattern.
    const double noise = outcome.fit.sigma_px / fit.sigma_px;
    const double rms_px = map_uncertainty(data.sensor, scratch.state.camera,
                                          outcome.grown * noise * noise * fit.camera_covariance)
                              .rms_px;
    if (rms_px < (best.told ? best.map_rms_px : outcome.map.rms_px)) {
      best = {true, view, rms_px};
    }
  }
  return best;
}

}  // namespace tubesight::core::calibration
