// Cameras there and back between our distortion and OpenCV's.

#include "core/calibration/opencv_lens.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tubesight::core::calibration {
namespace {

Sensor source_sensor() { return {0.0084 * 768 / 635, 0.0098, 635.0, 480.0}; }

CameraValues source_camera() {
  CameraValues camera;
  camera << 5.06, 1.021, 324.3, 233.8, 0.0092, 0.0;
  return camera;
}

TEST(OpencvLens, DistortsAsItsEquationSays) {
  OpencvLens lens;
  lens.distortion = {0.1, 0.01, 0.001, 0.002, -0.003, 0.02, 0.003, 0.0004};
  // By hand: x = 0.3, y = -0.4, r2 = 0.25; 1.02557812... / 1.00519375.
  const double q = (1.0 + 0.025 + 0.000625 - 0.000046875) / (1.0 + 0.005 + 0.0001875 + 0.00000625);

  const Eigen::Vector2d seen = distorted_by(lens, {0.3, -0.4});

  EXPECT_NEAR(seen.x(), 0.3 * q + 2.0 * 0.001 * -0.12 + 0.002 * (0.25 + 0.18), 1e-12);
  EXPECT_NEAR(seen.y(), -0.4 * q + 0.001 * (0.25 + 0.32) + 2.0 * 0.002 * -0.12, 1e-12);
}

TEST(OpencvLens, OfOursSeesTheSamePixelsToItsResidual) {
  ConversionResidual residual;
  const OpencvLens lens = opencv_lens_of(source_sensor(), source_camera(), residual);

  EXPECT_NEAR(lens.fx_px, 5.06 * 1.021 / (0.0084 * 768 / 635), 1e-9);
  EXPECT_NEAR(lens.fy_px, 5.06 / 0.0098, 1e-9);
  EXPECT_LT(lens.distortion[0], 0.0);
  EXPECT_LT(residual.rms_px, 0.2);
  EXPECT_GT(residual.worst_px, residual.rms_px);
  // A place of its own, by hand from ours: 250 px right of and 150 px below the centre.
  const double x = 250.0 * (0.0084 * 768 / 635) / 1.021;
  const double y = 150.0 * 0.0098;
  const double factor = (1.0 + 0.0092 * (x * x + y * y)) / 5.06;
  const Eigen::Vector2d seen = distorted_by(lens, {x * factor, y * factor});
  EXPECT_NEAR(lens.fx_px * seen.x() + lens.cx_px, 324.3 + 250.0, residual.worst_px);
  EXPECT_NEAR(lens.fy_px * seen.y() + lens.cy_px, 233.8 + 150.0, residual.worst_px);
}

TEST(OpencvLens, ComesBackAsTheCameraThatItWas) {
  ConversionResidual there;
  ConversionResidual back;
  const OpencvLens lens = opencv_lens_of(source_sensor(), source_camera(), there);

  const auto camera = camera_of(source_sensor(), lens, back);

  ASSERT_TRUE(camera);
  EXPECT_NEAR((*camera)(0), 5.06, 1e-9);
  EXPECT_NEAR((*camera)(1), 1.021, 1e-9);
  EXPECT_NEAR((*camera)(2), 324.3, 1e-9);
  EXPECT_NEAR((*camera)(3), 233.8, 1e-9);
  EXPECT_NEAR((*camera)(4), 0.0092, 2e-4);
  EXPECT_LT(back.rms_px, 0.3);
}

TEST(OpencvLens, TangentialTermsAreInTheResidual) {
  OpencvLens lens{500.0, 500.0, 317.0, 240.0, {}};
  ConversionResidual residual;
  ASSERT_TRUE(camera_of(source_sensor(), lens, residual));
  EXPECT_LT(residual.worst_px, 1e-6);

  lens.distortion[2] = 0.002;
  ASSERT_TRUE(camera_of(source_sensor(), lens, residual));
  EXPECT_GT(residual.rms_px, 0.1);
}

TEST(OpencvLens, ThatFoldsWithinThePictureIsRefused) {
  const OpencvLens lens{500.0, 500.0, 317.0, 240.0, {-0.9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
  ConversionResidual residual;

  const auto camera = camera_of(source_sensor(), lens, residual);

  ASSERT_FALSE(camera);
  EXPECT_EQ(camera.error(), Error::kOutOfRange);
}

}  // namespace
}  // namespace tubesight::core::calibration
