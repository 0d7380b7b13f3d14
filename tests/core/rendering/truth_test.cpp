// Expected values are worked out by hand from conventions.md, or come with a ray-traced recording.

#include "core/rendering/truth.h"

#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "core/rendering/projection.h"

namespace tubesight::core::rendering {
namespace {

/// 500 pixels per unit at distance 1, nothing distorted.
CameraSettings plain_camera() {
  CameraSettings camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.focal_length_mm = 5.0;
  camera.cell_width_mm = 0.01;
  camera.cell_height_mm = 0.01;
  camera.sensor_columns = 640;
  camera.frame_columns = 640;
  camera.center_px = {320.0, 240.0};
  return camera;
}

std::unique_ptr<Scene> plain_scene() {
  auto scene = std::make_unique<Scene>();
  scene->camera = plain_camera();
  scene->tool.position_mm = {0.0, 30.0, 110.0};
  scene->sheet.row_step_mm = {0.0, 20.0};
  scene->sheet.column_step_mm = {20.0, 0.0};
  scene->sheet.bore_mm = 10.0;
  scene->sheet.rows = {-100, 100};
  scene->sheet.columns = {-100, 100};
  scene->look.bore_spread_mm = 0.0;
  return scene;
}

Transform<frames::Sheet, frames::Tool> pose(const std::array<double, 3>& mm,
                                            const std::array<double, 3>& degrees) {
  return {rotation_from_degrees(degrees), {mm[0], mm[1], mm[2]}};
}

void expect_pixel(const std::optional<std::array<double, 2>>& pixel, double u, double v,
                  double tolerance = 1e-6) {
  ASSERT_TRUE(pixel.has_value());
  EXPECT_NEAR((*pixel)[0], u, tolerance);
  EXPECT_NEAR((*pixel)[1], v, tolerance);
}

TEST(ProjectionPixel, FollowsTheDefinitionOfThePinhole) {
  const auto camera = Projection::make(plain_camera());
  ASSERT_TRUE(camera.has_value());

  // (10, -5, 100) mm: 320 + 500 * 10 / 100, 240 - 500 * 5 / 100.
  expect_pixel(camera->pixel({10.0, -5.0, 100.0}), 370.0, 215.0);
}

TEST(ProjectionPixel, UndoesTheDistortionOfTheSource) {
  CameraSettings settings = plain_camera();
  settings.distortion_per_mm2 = 0.01;
  settings.distortion2_per_mm4 = 0.001;
  const auto camera = Projection::make(settings);
  ASSERT_TRUE(camera.has_value());

  // Distorted (0.6, -0.8) mm lies 1 mm off the axis: ideal (0.6, -0.8) * 1.011, at EFL 5.
  expect_pixel(camera->pixel({0.6066, -0.8088, 5.0}), 380.0, 160.0);
  const Eigen::Vector3d ray = camera->ray(380.0, 160.0);
  EXPECT_NEAR(ray.x(), 0.12132, 1e-12);
  EXPECT_NEAR(ray.y(), -0.16176, 1e-12);
}

TEST(ProjectionPixel, ScalesColumnsBySensorAndFrame) {
  CameraSettings settings = plain_camera();
  settings.cell_width_mm = 0.0084;
  settings.sensor_columns = 768;
  settings.horizontal_scale = 1.02;
  const auto camera = Projection::make(settings);
  ASSERT_TRUE(camera.has_value());

  // 1 mm on the sensor: 1 * 1.02 * 640 / (0.0084 * 768) = 652.8 / 6.4512 = 101.190476 columns.
  expect_pixel(camera->pixel({1.0, 0.0, 5.0}), 421.190476, 240.0, 1e-5);
}

TEST(ProjectionPixel, IsEmptyBehindTheCamera) {
  const auto camera = Projection::make(plain_camera());
  ASSERT_TRUE(camera.has_value());

  EXPECT_FALSE(camera->pixel({1.0, 1.0, -10.0}).has_value());
  EXPECT_FALSE(camera->pixel({100.0, 0.0, 1.0}).has_value());
}

TEST(ProjectionMake, RefusesWhatNoCameraIs) {
  CameraSettings settings = plain_camera();
  settings.focal_length_mm = 0.0;
  EXPECT_FALSE(Projection::make(settings).has_value());
  settings = plain_camera();
  settings.distortion_per_mm2 = -0.1;  // folds over at 1.8 mm, the corner is at 4
  EXPECT_FALSE(Projection::make(settings).has_value());
}

TEST(TruthImage, ChainsSheetToolAndCamera) {
  const auto truth = std::make_unique<Truth>();
  ASSERT_TRUE(truth->configure(*plain_scene()).has_value());

  // Straight below: tool (0, 0, 60), camera (0, 30, 170): v = 240 + 500 * 30 / 170.
  expect_pixel(truth->image_of(pose({100, 50, -60}, {0, 0, 0}), {100.0, 50.0, 0.0}), 320.0,
               328.235294);
  // Heading 90 degrees: the sheet's y is the tool's x: tool (10, 0, 60), camera (10, 30, 170).
  expect_pixel(truth->image_of(pose({100, 50, -60}, {90, 0, 0}), {100.0, 60.0, 0.0}), 349.411765,
               328.235294);
}

TEST(TruthImage, TurnsTheCameraAsTheToolCalibrationSays) {
  auto scene = plain_scene();
  scene->tool = {{0.0, 60.0, 100.0}, {0.0, 0.0, 90.0}};  // tool (x, y, z) is camera (x, -z, y)
  const auto truth = std::make_unique<Truth>();
  ASSERT_TRUE(truth->configure(*scene).has_value());

  // Tool (5, 20, 60) is camera (5, -60, 20) + (0, 60, 100) = (5, 0, 120).
  expect_pixel(truth->image_of(pose({0, 0, -60}, {0, 0, 0}), {5.0, 20.0, 0.0}), 340.833333, 240.0);
}

TEST(TruthImage, SeesACameraKnockedLoose) {
  const auto truth = std::make_unique<Truth>();
  ASSERT_TRUE(truth->configure(*plain_scene()).has_value());
  const Transform<frames::Camera, frames::Camera> knock(rotation_from_degrees({90.0, 0.0, 0.0}),
                                                        Eigen::Vector3d::Zero());

  // Camera (0, 30, 170) turned by 90 degrees about the axis: (-30, 0, 170).
  expect_pixel(truth->image_of(pose({0, 0, -60}, {0, 0, 0}), {0.0, 0.0, 0.0}, knock), 231.764706,
               240.0);
}

TEST(TruthTubeImage, OfARimParallelToTheSensorIsACircle) {
  const auto truth = std::make_unique<Truth>();
  ASSERT_TRUE(truth->configure(*plain_scene()).has_value());

  // Radius 5 mm at 170 mm: 500 * 5 / 170 px around the centre.
  const auto image = truth->tube_image(pose({0, 0, -60}, {0, 0, 0}), {0, 0});
  ASSERT_TRUE(image.has_value());
  EXPECT_NEAR(image->ellipse_px[0], 320.0, 1e-6);
  EXPECT_NEAR(image->ellipse_px[1], 328.235294, 1e-6);
  EXPECT_NEAR(image->half_px[0], 14.705882, 1e-4);
  EXPECT_NEAR(image->half_px[1], 14.705882, 1e-4);
  EXPECT_EQ(image->rim_in_frame, 1.0);
}

/// The first field of the ray-traced recording sq_clean: its camera, tool, pose and centers.csv.
class RecordedTruth : public ::testing::Test {
 protected:
  RecordedTruth() {
    CameraSettings& camera = scene_->camera;
    camera.width_px = 635;
    camera.focal_length_mm = 5.06;
    camera.cell_width_mm = 0.0084;
    camera.cell_height_mm = 0.0098;
    camera.sensor_columns = 768;
    camera.frame_columns = 635;
    camera.horizontal_scale = 1.021;
    camera.center_px = {324.3, 233.8};
    camera.distortion_per_mm2 = 0.0092;
    scene_->tool = {{-3.074145, 31.628971, 112.789218}, {-0.0639064, -0.8174368, 47.9947489}};
    scene_->sheet.row_step_mm = {0.0, 25.4};
    scene_->sheet.column_step_mm = {25.4, 0.0};
  }
  std::unique_ptr<Scene> scene_ = plain_scene();
  // alpha, beta, gamma of the recording: 0.03490659, -0.00174533, 0.00261799 rad.
  Transform<frames::Sheet, frames::Tool> pose_ = pose({1524.4, 1015.7, -60.0}, {2.0, -0.1, 0.15});
};

TEST_F(RecordedTruth, HasTheSameCentresAndEllipses) {
  scene_->sheet.bore_mm = 18.5503;  // of tube (38, 58)
  const auto truth = std::make_unique<Truth>();
  ASSERT_TRUE(truth->configure(*scene_).has_value());

  const auto image = truth->tube_image(pose_, {38, 58});

  ASSERT_TRUE(image.has_value());
  EXPECT_NEAR(image->center_px[0], 96.972, 1e-3);
  EXPECT_NEAR(image->center_px[1], 46.265, 1e-3);
  EXPECT_NEAR(image->ellipse_px[0], 96.353, 1e-3);
  EXPECT_NEAR(image->ellipse_px[1], 44.249, 1e-3);
  EXPECT_NEAR(image->half_px[0], 36.33, 0.01);
  EXPECT_NEAR(image->half_px[1], 34.17, 0.01);
}

TEST_F(RecordedTruth, PointsAtTheSamePlace) {
  const auto truth = std::make_unique<Truth>();
  ASSERT_TRUE(truth->configure(*scene_).has_value());

  const auto axis = truth->axis(pose_);

  ASSERT_TRUE(axis.has_value());
  EXPECT_NEAR(axis->axis_mm[0], 1524.30083, 1e-4);
  EXPECT_NEAR(axis->axis_mm[1], 1015.53936, 1e-4);
  EXPECT_EQ(axis->nearest.address, (TubeAddress{40, 60}));
  EXPECT_NEAR(axis->nearest.offset_mm, 0.5502, 1e-4);
  EXPECT_NEAR(axis->nearest.off_mm[0], 0.3008, 1e-4);
  EXPECT_NEAR(axis->nearest.off_mm[1], -0.4606, 1e-4);
}

TEST_F(RecordedTruth, HasTheSameTransformFromTheSheet) {
  const auto truth = std::make_unique<Truth>();
  ASSERT_TRUE(truth->configure(*scene_).has_value());

  const auto T = truth->T_camera_sheet(pose_);

  EXPECT_NEAR(T.translation_mm().x(), -1552.92568578, 1e-4);
  EXPECT_NEAR(T.translation_mm().y(), -658.69768256, 1e-4);
  EXPECT_NEAR(T.translation_mm().z(), -575.29662714 - 5.06, 1e-4);  // ours: less by EFL
  EXPECT_NEAR(T.rotation()(0, 1), 0.02507492, 1e-7);
  EXPECT_NEAR(T.rotation()(2, 2), 0.67109738, 1e-7);
}

TEST_F(RecordedTruth, KnowsWhatTheGuidetubeHides) {
  scene_->guidetube.radius_mm = 9.1;
  const auto truth = std::make_unique<Truth>();
  ASSERT_TRUE(truth->configure(*scene_).has_value());

  // In the picture tube (43, 60) stands behind the guidetube's tip, (44, 60) wholly behind it.
  EXPECT_EQ(truth->tube_image(pose_, {41, 60})->occluded, 0.0);
  EXPECT_GT(truth->tube_image(pose_, {44, 60})->occluded, 0.3);
  EXPECT_LT(truth->tube_image(pose_, {44, 60})->occluded, 0.8);
  EXPECT_EQ(truth->tube_image(pose_, {46, 60})->occluded, 1.0);
}

}  // namespace
}  // namespace tubesight::core::rendering
