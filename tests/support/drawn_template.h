#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "core/picture/averaged_picture.h"

namespace tubesight::tests {

/// A calibration template of bright or dark dots as a camera with radial distortion sees it, drawn
/// from the picture back to the plane, so that nothing of it comes from the code under test.
///
/// Where an edge is near a pixel is divided in 4 x 4, of which each is covered by its distance from
/// the edge; the optics then smear whole pixels, which moves no centroid.
struct DrawnTemplate {
  std::int32_t width_px = 635;
  std::int32_t height_px = 480;
  double efl_mm = 5.06;
  double column_mm = 0.0084 * 768 / 635;  ///< a pixel's width, before `scale`
  double row_mm = 0.0098;
  double scale = 1.0;  ///< h_sx
  Eigen::Vector2d center_px{317.0, 239.5};
  double k_per_mm2 = 0.0;

  std::int32_t rows = 10;
  std::int32_t columns = 10;
  double spacing_mm = 8.0;
  double dot_mm = 4.0;
  /// From template to camera; dot (0, 0) is the template's origin.
  Eigen::Matrix3d R_camera_target = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_camera_target = Eigen::Vector3d::Zero();

  double background = 14.0;  ///< grey levels
  double inside = 180.0;
  double falling_off = 0.0;   ///< share of the light lost in the picture's corners
  double smear_px = 0.7;      ///< of the optics, one sigma
  std::int32_t moved_px = 0;  ///< along u while it was exposed
  double noise = 1.0;         ///< of a frame, grey levels
  std::int32_t frames = 4;    ///< averaged, each in whole grey levels

  /// Draws it into `pixels`, which the picture returned looks at.
  [[nodiscard]] core::picture::AveragedPicture draw(std::mt19937_64& random,
                                                    std::vector<std::uint16_t>& pixels) const;

 private:
  [[nodiscard]] Eigen::Vector2d on_template(double u, double v) const;
  [[nodiscard]] double depth_mm(double u, double v) const;
  [[nodiscard]] double cover_of(std::int32_t u, std::int32_t v) const;
};

}  // namespace tubesight::tests
