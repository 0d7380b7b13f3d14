#include "core/calibration/imaging.h"

#include <cmath>
#include <numbers>

namespace tubesight::core::calibration {
namespace {

/// The radial factor f of x_c = x_d f(r_d^2), and f + 2 r^2 f', which is d r_c / d r_d.
struct Radial {
  double factor;
  double slope;
};
Radial radial_at(const CameraValues& camera, double r2) {
  const double k = camera(4);
  const double k2 = camera(5);
  const double factor = 1.0 + r2 * (k + k2 * r2);
  return {factor, factor + 2.0 * r2 * (k + 2.0 * k2 * r2)};
}

/// r_d of r_c = r_d f(r_d^2).
double distorted_radius(const CameraValues& camera, double ideal) {
  double r = ideal;
  constexpr int kRounds = 20;  // quadratic: four or five do
  for (int round = 0; round < kRounds; ++round) {
    const Radial radial = radial_at(camera, r * r);
    const double step = (r * radial.factor - ideal) / std::fmax(radial.slope, 0.05);
    r -= step;
    if (std::abs(step) < 1e-14 * (1.0 + r)) {
      break;
    }
  }
  return r;
}

/// What tangential distortion adds to an ideal place.
Eigen::Vector2d tangential_at(const TangentialValues& p, const Eigen::Vector2d& d) {
  const double r2 = d.squaredNorm();
  const double cross = 2.0 * d.x() * d.y();
  return {p.x() * cross + p.y() * (r2 + 2.0 * d.x() * d.x()),
          p.x() * (r2 + 2.0 * d.y() * d.y()) + p.y() * cross};
}

Eigen::Vector2d distorted_of(const CameraValues& camera, const Eigen::Vector2d& ideal) {
  const double radius = ideal.norm();
  return radius > 0.0 ? Eigen::Vector2d(ideal * (distorted_radius(camera, radius) / radius))
                      : ideal;
}

/// An image and how large an area of the plane through the place and normal to the axis is there,
/// but for constants: d(u, v) over d(x, y) is 1 / (z^3 det(d ideal / d distorted)).
struct Image {
  Eigen::Vector2d pixel;
  double area;
};
Image image_of(const Sensor& sensor, const CameraValues& camera, const Eigen::Vector3d& place,
               const TangentialValues& tangential) {
  const Eigen::Vector2d ideal = camera(0) * place.head<2>() / place.z();
  Eigen::Vector2d distorted = distorted_of(camera, ideal);
  if (tangential != TangentialValues::Zero()) {
    // Newton's method with the radial part's slopes alone: f across the radius, f + 2 r^2 f' along.
    constexpr int kRounds = 12;  // each leaves a hundredth of the error before
    for (int round = 0; round < kRounds; ++round) {
      const double r2 = distorted.squaredNorm();
      const Radial radial = radial_at(camera, r2);
      const Eigen::Vector2d off =
          distorted * radial.factor + tangential_at(tangential, distorted) - ideal;
      const Eigen::Vector2d along =
          r2 > 0.0 ? Eigen::Vector2d(distorted * (distorted.dot(off) / r2)) : off;
      const Eigen::Vector2d step = (off - along) / radial.factor + along / radial.slope;
      distorted -= step;
      if (step.squaredNorm() < 1e-28) {
        break;
      }
    }
  }
  const Radial radial = radial_at(camera, distorted.squaredNorm());
  return {{camera(2) + distorted.x() * camera(1) / sensor.column_mm,
           camera(3) + distorted.y() / sensor.row_mm},
          1.0 / (place.z() * place.z() * place.z() * radial.factor * radial.slope)};
}

}  // namespace

Sensor sensor_of(const CameraSettings& camera) {
  return {camera.cell_width_mm * camera.sensor_columns / camera.frame_columns,
          camera.cell_height_mm, static_cast<double>(camera.width_px),
          static_cast<double>(camera.height_px)};
}

Eigen::Vector2d ideal_of(const Sensor& sensor, const CameraValues& camera,
                         const Eigen::Vector2d& pixel, const TangentialValues& tangential) {
  const Eigen::Vector2d distorted(sensor.column_mm / camera(1) * (pixel.x() - camera(2)),
                                  sensor.row_mm * (pixel.y() - camera(3)));
  return distorted * radial_at(camera, distorted.squaredNorm()).factor +
         tangential_at(tangential, distorted);
}

Eigen::Vector2d pixel_of(const Sensor& sensor, const CameraValues& camera,
                         const Eigen::Vector3d& place_mm, const TangentialValues& tangential) {
  return image_of(sensor, camera, place_mm, tangential).pixel;
}

Eigen::Vector2d centroid_of(const Sensor& sensor, const CameraValues& camera,
                            const TargetPose& pose, const Eigen::Vector3d& center_mm,
                            double radius_mm, const TangentialValues& tangential) {
  const Eigen::Vector3d center = pose.R_camera_target * center_mm + pose.t_camera_target;
  const Image middle = image_of(sensor, camera, center, tangential);
  if (!(radius_mm > 0.0)) {
    return middle.pixel;
  }
  Eigen::Vector2d moment = middle.pixel * (2.0 * middle.area);
  double area = 2.0 * middle.area;
  constexpr int kCorners = 6;
  const double reach = radius_mm * std::sqrt(2.0 / 3.0);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const Image image = image_of(sensor, camera,
                                 center + reach * (std::cos(angle) * pose.R_camera_target.col(0) +
                                                   std::sin(angle) * pose.R_camera_target.col(1)),
                                 tangential);
    moment += image.pixel * image.area;
    area += image.area;
  }
  return moment / area;
}

}  // namespace tubesight::core::calibration
