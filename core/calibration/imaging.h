#pragma once

#include <Eigen/Core>

#include "core/base/settings.h"

namespace tubesight::core::calibration {

/// The camera's parameters in the order of pose::CameraParameter: EFL, h_sx, c_u, c_v, k, k2.
using CameraValues = Eigen::Matrix<double, 6, 1>;

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

/// The undistorted place on the ideal image plane of a pixel, mm [Fallon eq. 4.5-4.9].
[[nodiscard]] Eigen::Vector2d ideal_of(const Sensor& sensor, const CameraValues& camera,
                                       const Eigen::Vector2d& pixel);

/// The pixel of a place in the camera frame, in front of the camera: the inverse, by Newton's
/// method on the radius. core/camera has it for settings at rest; here they change with every step
/// of a fit.
[[nodiscard]] Eigen::Vector2d pixel_of(const Sensor& sensor, const CameraValues& camera,
                                       const Eigen::Vector3d& place_mm);

/// The centroid of the image of a disc of the template's plane.
///
/// A centroid is not the centre's image: perspective and distortion enlarge one side of the dot
/// [Heikkila2000]. The mean of the image of the disc's points, weighted with the area each takes
/// there, is integrated by seven points, exact to the fifth degree in the place on the disc
/// [Stroud1971 S2: 5-1]. A radius of 0 gives the centre's image.
[[nodiscard]] Eigen::Vector2d centroid_of(const Sensor& sensor, const CameraValues& camera,
                                          const TargetPose& pose, const Eigen::Vector3d& center_mm,
                                          double radius_mm);

}  // namespace tubesight::core::calibration
