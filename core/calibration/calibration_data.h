#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "core/base/static_vector.h"
#include "core/calibration/imaging.h"

namespace tubesight::core::calibration {

/// Views of a template that one calibration takes.
inline constexpr std::int32_t kMaxViews = 32;
/// Dots of all views: 16 of the largest template that is found.
inline constexpr std::int32_t kMaxDots = 16384;

/// A dot of the template, where it is there and where a picture shows it.
struct SeenDot {
  Eigen::Vector3d place_mm = Eigen::Vector3d::Zero();
  Eigen::Vector2d seen_px = Eigen::Vector2d::Zero();      ///< centroid
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();  ///< seen less computed, by the fit
  bool used = true;
};

/// One view: a run of the dots.
struct CalibrationView {
  std::int32_t first = 0;
  std::int32_t count = 0;
  bool staged = false;     ///< on the translation stage, at `height_mm`; else a free pose
  double height_mm = 0.0;  ///< larger: the camera is farther away
};

/// All that a calibration is made from. 1.2 MB: in a workspace.
struct CalibrationData {
  Sensor sensor;
  double lens_mm = 0.0;        ///< EFL by the data sheet, 0: not known
  double dot_radius_mm = 0.0;  ///< 0: points, whose images were measured themselves
  StaticVector<SeenDot, kMaxDots> dots;
  StaticVector<CalibrationView, kMaxViews> views;
};

/// How far a template's dots stand out of its plane, by the place on it in halves of its extent
/// from its middle: bow(0) a^2 + bow(1) a b + bow(2) b^2 mm towards its normal.
using BowValues = Eigen::Vector3d;

/// What is fitted: the camera, the stage that carries it, the free poses, and what a lens and a
/// template may have beside that.
struct CalibrationState {
  CameraValues camera = CameraValues::Zero();
  TangentialValues tangential = TangentialValues::Zero();
  BowValues bow_mm = BowValues::Zero();
  TargetPose stage;  ///< of the template at height 0
  /// How the template moves in the camera frame for 1 mm of height: along its normal, or near that,
  /// as a stage need not stand quite square to it.
  Eigen::Vector3d stage_axis = Eigen::Vector3d::UnitZ();
  StaticVector<TargetPose, kMaxViews>
      poses;  ///< of all views; of the staged ones made of the above
};

/// The pose of a staged view.
[[nodiscard]] inline TargetPose pose_at(const CalibrationState& state, double height_mm) {
  return {state.stage.R_camera_target, state.stage.t_camera_target + height_mm * state.stage_axis};
}

}  // namespace tubesight::core::calibration
