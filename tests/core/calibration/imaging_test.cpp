#include "core/calibration/imaging.h"

#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace tubesight::core::calibration {
namespace {

TEST(Imaging, MapsBackWhatItMapped) {
  const Sensor sensor{0.0102, 0.0098, 635.0, 480.0};
  CameraValues camera;
  camera << 5.06, 1.021, 324.3, 233.8, 0.0092, -1e-4;
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(0.0, 0.0, 80.0), Eigen::Vector3d(40.0, -30.0, 80.0),
        Eigen::Vector3d(-45.0, 33.0, 90.0)}) {
    const Eigen::Vector2d pixel = pixel_of(sensor, camera, place);
    const Eigen::Vector2d ideal = ideal_of(sensor, camera, pixel);
    EXPECT_NEAR(ideal.x(), 5.06 * place.x() / place.z(), 1e-10);
    EXPECT_NEAR(ideal.y(), 5.06 * place.y() / place.z(), 1e-10);
  }
}

TEST(Imaging, ACentroidIsThatOfTheDotsPixels) {
  // The dot's image counted on a grid of a hundredth of a pixel, back through the lens to the
  // plane.
  const Sensor sensor{0.0102, 0.0098, 635.0, 480.0};
  CameraValues camera;
  camera << 5.06, 1.021, 324.3, 233.8, 0.0092, 0.0;
  TargetPose pose;
  constexpr double kDegree = std::numbers::pi / 180.0;
  pose.R_camera_target = (Eigen::AngleAxisd(40.0 * kDegree, Eigen::Vector3d::UnitX()) *
                          Eigen::AngleAxisd(15.0 * kDegree, Eigen::Vector3d::UnitY()) *
                          Eigen::AngleAxisd(10.0 * kDegree, Eigen::Vector3d::UnitZ()))
                             .toRotationMatrix();
  pose.t_camera_target << 20.0, 18.0, 60.0;
  const Eigen::Vector3d center(3.0, 2.0, 0.0);
  constexpr double kRadius_mm = 4.0;
  const Eigen::Vector2d middle =
      pixel_of(sensor, camera, pose.R_camera_target * center + pose.t_camera_target);
  const Eigen::Vector3d normal = pose.R_camera_target.col(2);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (int i = -2500; i <= 2500; i += 5) {
    for (int k = -2500; k <= 2500; k += 5) {
      const Eigen::Vector2d pixel = middle + 0.02 * Eigen::Vector2d(i, k);
      const Eigen::Vector2d ideal = ideal_of(sensor, camera, pixel);
      const Eigen::Vector3d ray(ideal.x(), ideal.y(), camera(0));
      const Eigen::Vector3d place = ray * (normal.dot(pose.t_camera_target) / normal.dot(ray));
      const Eigen::Vector3d on_target =
          pose.R_camera_target.transpose() * (place - pose.t_camera_target);
      if ((on_target - center).squaredNorm() <= kRadius_mm * kRadius_mm) {
        sum += pixel;
        count += 1.0;
      }
    }
  }
  ASSERT_GT(count, 10000.0);

  const Eigen::Vector2d computed = centroid_of(sensor, camera, pose, center, kRadius_mm);

  EXPECT_LT((computed - sum / count).norm(), 0.01);
  EXPECT_GT((computed - middle).norm(), 0.1);  // the bias that is taken out
}

}  // namespace
}  // namespace tubesight::core::calibration
