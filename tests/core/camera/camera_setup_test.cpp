#include "core/camera/camera_setup.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/core/camera/camera_test_support.h"
#include "tests/support/scalars.h"

namespace tubesight::core::camera {
namespace {

template <typename S>
class CameraSetupTest : public ::testing::Test {};

using tests::Scalars;
TYPED_TEST_SUITE(CameraSetupTest, Scalars);

template <typename S>
void expect_refused(const CameraSettings& settings, const char* why) {
  const Result<CameraModel<S>> model = make_camera_model<S>(settings);
  ASSERT_FALSE(model.has_value()) << why;
  EXPECT_EQ(model.error(), Error::kOutOfRange) << why;
}

TYPED_TEST(CameraSetupTest, TurnsSettingsIntoParameters) {
  const auto model = make_camera_model<TypeParam>(source_camera());
  ASSERT_TRUE(model.has_value());
  const auto& p = model->parameters();
  EXPECT_NEAR(static_cast<double>(p.center_px.x), 324.3, 2e-5);
  EXPECT_NEAR(static_cast<double>(p.center_px.y), 233.8, 2e-5);
  // 5.06 * 1.021 * 635 / (0.0084 * 768) and 5.06 / 0.0098.
  EXPECT_NEAR(static_cast<double>(p.scale_px.x), 508.521685888, 5e-5);
  EXPECT_NEAR(static_cast<double>(p.scale_px.y), 516.326530612, 5e-5);
  EXPECT_NEAR(static_cast<double>(p.distortion), 0.23555312, 1e-7);  // 0.0092 * 25.6036
  EXPECT_EQ(static_cast<double>(p.distortion2), 0.0);
}

TYPED_TEST(CameraSetupTest, RefusesScalesOutsideTheFormat) {
  CameraSettings settings = source_camera();
  settings.distortion_per_mm2 = 0.0;
  settings.cell_height_mm = 5.06 / 31.0;
  expect_refused<TypeParam>(settings, "31 px per EFL");
  settings.cell_height_mm = 5.06 / 16001.0;
  expect_refused<TypeParam>(settings, "16,001 px per EFL");
  settings.cell_height_mm = 5.06 / 15999.0;
  EXPECT_TRUE(make_camera_model<TypeParam>(settings).has_value());
  settings.cell_height_mm = 0.0;
  expect_refused<TypeParam>(settings, "a cell of no height");
  settings.cell_height_mm = std::numeric_limits<double>::quiet_NaN();
  expect_refused<TypeParam>(settings, "not a number");
}

TYPED_TEST(CameraSetupTest, RefusesWhatIsNotAboveZero) {
  CameraSettings settings = source_camera();
  settings.cell_width_mm = -0.0084;
  expect_refused<TypeParam>(settings, "cell width");
  settings = source_camera();
  settings.horizontal_scale = 0.0;
  expect_refused<TypeParam>(settings, "horizontal scale");
  settings = source_camera();
  settings.sensor_columns = 0;
  expect_refused<TypeParam>(settings, "sensor columns");
  settings = source_camera();
  settings.frame_columns = 0;
  expect_refused<TypeParam>(settings, "frame columns");
  settings = source_camera();
  settings.focal_length_mm = 0.0;
  expect_refused<TypeParam>(settings, "focal length");
}

TYPED_TEST(CameraSetupTest, RefusesDistortionsOutsideTheFormat) {
  CameraSettings settings = source_camera();
  for (const double k : {2.01, -2.01, std::numeric_limits<double>::quiet_NaN()}) {
    settings.distortion_per_mm2 = k / (5.06 * 5.06);
    expect_refused<TypeParam>(settings, "k EFL^2");
  }
  settings.distortion_per_mm2 = 0.0;
  settings.distortion2_per_mm4 = 2.01 / (5.06 * 5.06 * 5.06 * 5.06);
  expect_refused<TypeParam>(settings, "k2 EFL^4");
}

TYPED_TEST(CameraSetupTest, RefusesPicturesThatFoldOver) {
  // The corner is at r = 0.797; pin-cushion distortion turns back at r^2 = 1 / (3 |k|).
  CameraSettings settings = source_camera();
  settings.distortion_per_mm2 = -0.53 / (5.06 * 5.06);
  expect_refused<TypeParam>(settings, "folds at r = 0.793");
  settings.distortion_per_mm2 = -0.48 / (5.06 * 5.06);
  EXPECT_TRUE(make_camera_model<TypeParam>(settings).has_value()) << "folds at r = 0.833";
}

TYPED_TEST(CameraSetupTest, RefusesPicturesOver60DegreesOffTheAxis) {
  CameraSettings settings = source_camera();
  settings.distortion_per_mm2 = 0.0;
  settings.focal_length_mm = 2.0;  // corner at 0.797 * 5.06 / 2 = 2.02
  expect_refused<TypeParam>(settings, "63 degrees");
  settings.focal_length_mm = 2.4;  // 1.68
  EXPECT_TRUE(make_camera_model<TypeParam>(settings).has_value());
}

TYPED_TEST(CameraSetupTest, RefusesACentreFarOffThePicture) {
  CameraSettings settings = source_camera();
  settings.center_px = {9000.0, 200.0};
  expect_refused<TypeParam>(settings, "centre");
}

TYPED_TEST(CameraSetupTest, TakesTheToolsAxesForThePlane) {
  using S = TypeParam;
  // Alpha = 90 degrees: the tool's x is the camera's y.
  const auto plane = make_virtual_plane<S>(
      Transform<frames::Camera, frames::Tool>(rotation_from_degrees({90, 0, 0}), {1, 2, 3}));
  const double bound = bound_of<S>({1e-15, 1e-7, 1e-9});
  EXPECT_NEAR(static_cast<double>(plane.x_axis().y), 1.0, bound);
  EXPECT_NEAR(static_cast<double>(plane.x_axis().x), 0.0, bound);
  EXPECT_NEAR(static_cast<double>(plane.y_axis().x), -1.0, bound);
  EXPECT_NEAR(static_cast<double>(plane.normal().z), 1.0, bound);
}

}  // namespace
}  // namespace tubesight::core::camera
