#pragma once

#include <array>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/calibration/imaging.h"

namespace tubesight::core::calibration {

/// A camera as OpenCV and ROS have it: an ideal place (x, y) over the focal length, r^2 = x^2 +
/// y^2, is seen at
///   x' = x q + 2 p1 x y + p2 (r^2 + 2 x^2),   q = (1 + k1 r^2 + k2 r^4 + k3 r^6)
///   y' = y q + p1 (r^2 + 2 y^2) + 2 p2 x y         / (1 + k4 r^2 + k5 r^4 + k6 r^6)
///   u = fx x' + cx,  v = fy y' + cy,
/// pixel (0, 0) the centre of the top-left one. Ours goes the other way, from seen to ideal.
struct OpencvLens {
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  std::array<double, 8> distortion{};  ///< k1, k2, p1, p2, k3, k4, k5, k6
};

/// What the other model does not follow, over the picture.
struct ConversionResidual {
  double rms_px = 0.0;
  double worst_px = 0.0;
};

/// Where a place of the ideal image over the focal length is seen, likewise.
[[nodiscard]] Eigen::Vector2d distorted_by(const OpencvLens& lens, const Eigen::Vector2d& ideal);

/// The lens that comes nearest to ours with k1, k2 and k3, by least squares of pixels over the
/// picture.
[[nodiscard]] OpencvLens opencv_lens_of(const Sensor& sensor, const CameraValues& camera,
                                        ConversionResidual& residual);

/// Our camera that comes nearest, by least squares over the picture of the rays' places on the
/// ideal image, in pixels; EFL, h_sx and the centre are the other's. p1 and p2 have no counterpart
/// in ours and are in the residual. kOutOfRange: the lens folds within the picture, a pixel has no
/// ray.
[[nodiscard]] Result<CameraValues> camera_of(const Sensor& sensor, const OpencvLens& lens,
                                             ConversionResidual& residual);

}  // namespace tubesight::core::calibration
