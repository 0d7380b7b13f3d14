#pragma once

#include <Eigen/Core>

#include "core/base/settings.h"

namespace tubesight::core::calibration {

/// The camera's parameters in the order of pose::CameraParameter: EFL, h_sx, c_u, c_v, k, k2.
using CameraValues = Eigen::Matrix<double, 6, 1>;

/// Tangential distortion p1, p2 per mm [Brown1966], which a camera's settings have no place for:
/// fitted to tell that a lens has it.
using TangentialValues = Eigen::Vector2d;

/// What is known of the camera beforehand.
struct Sensor {
  double column_mm = 0.0;  ///< dx N_cx / N_fx: a pixel's width before h_sx
  double row_mm = 0.0;     ///< dy
  double width_px = 0.0;
  double height_px = 0.0;
};
[[nodiscard]] Sensor sensor_of(const CameraSettings& camera);

/// Where the template is: P_camera = R P + t.
struct TargetPose {
  Eigen::Matrix3d R_camera_target = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_camera_target = Eigen::Vector3d::Zero();
};

/// The undistorted place on the ideal image plane of a pixel, mm [Fallon eq. 4.5-4.9]. Tangential
/// distortion adds (2 p1 x y + p2 (r^2 + 2 x^2), p1 (r^2 + 2 y^2) + 2 p2 x y).
[[nodiscard]] Eigen::Vector2d ideal_of(const Sensor& sensor, const CameraValues& camera,
                                       const Eigen::Vector2d& pixel,
                                       const TangentialValues& tangential = {0.0, 0.0});

/// The pixel of a place in the camera frame, in front of the camera: the inverse, by Newton's
/// method on the radius. core/camera has it for settings at rest; here they change with every step
/// of a fit.
[[nodiscard]] Eigen::Vector2d pixel_of(const Sensor& sensor, const CameraValues& camera,
                                       const Eigen::Vector3d& place_mm,
                                       const TangentialValues& tangential = {0.0, 0.0});

/// The centroid of the image of a disc of the template's plane.
///
/// A centroid is not the centre's image: perspective and distortion enlarge one side of the dot
/// [Heikkila2000]. The mean of the image of the disc's points, weighted with the area each takes
/// there, is integrated by seven points, exact to the fifth degree in the place on the disc
/// [Stroud1971 S2: 5-1]. A radius of 0 gives the centre's image. The weights pass over tangential
/// distortion, which changes them by a thousandth over a dot.
[[nodiscard]] Eigen::Vector2d centroid_of(const Sensor& sensor, const CameraValues& camera,
                                          const TargetPose& pose, const Eigen::Vector3d& center_mm,
                                          double radius_mm,
                                          const TangentialValues& tangential = {0.0, 0.0});

}  // namespace tubesight::core::calibration
