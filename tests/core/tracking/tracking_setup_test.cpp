#include "core/tracking/tracking_setup.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class TrackingSetup : public ::testing::Test {
 protected:
  [[nodiscard]] Result<void> make() {
    return make_tracking_model<S>(*scene_.settings, scene_.model);
  }
  void expect(Error error) {
    const auto result = make();
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error(), error);
  }

  Scene<S> scene_;
};
TYPED_TEST_SUITE(TrackingSetup, Scalars);

TYPED_TEST(TrackingSetup, ReadsLargerPicturesInLargerSteps) {
  struct Case {
    std::int32_t width_px, height_px, step_px;
  };
  for (const Case& c :
       {Case{320, 240, 1}, Case{635, 480, 1}, Case{720, 576, 1}, Case{959, 720, 1},
        Case{960, 720, 2}, Case{1280, 1024, 2}, Case{1920, 1200, 3}, Case{1200, 1920, 3}}) {
    CameraSettings& camera = this->scene_.settings->camera;
    const double columns = static_cast<double>(c.width_px) / camera.width_px;
    const double lines = static_cast<double>(c.height_px) / camera.height_px;
    camera.cell_width_mm /= columns;
    camera.cell_height_mm /= lines;
    camera.center_px = {camera.center_px[0] * columns, camera.center_px[1] * lines};
    camera.width_px = c.width_px;
    camera.height_px = c.height_px;
    ASSERT_TRUE(this->make().has_value()) << c.width_px;
    EXPECT_EQ(this->scene_.model.reading_step_px, c.step_px) << c.width_px;
  }
}

TYPED_TEST(TrackingSetup, TakesTheSettingsOver) {
  this->scene_.settings->motion = {250.0, 4000.0};
  this->scene_.settings->verification.aligned_within_mm = 1.5;
  this->scene_.settings->edges = {300, 70};
  ASSERT_TRUE(this->make().has_value());
  const auto& model = this->scene_.model;
  EXPECT_EQ(number(model.tip_mm.y), 31.5);
  EXPECT_NEAR(number(model.bore_radius_mm), 9.3, 1e-6);
  EXPECT_EQ(model.window, (PixelBox{40, 36, 595, 330}));
  EXPECT_EQ(number(model.optimum_px.x), 318.0);
  EXPECT_EQ(number(model.max_speed_mm_s), 250.0);
  EXPECT_EQ(number(model.max_acceleration_m_s2), 4.0);
  EXPECT_EQ(number(model.aligned_within_mm), 1.5);
  EXPECT_EQ(model.initial_threshold, 300);
  EXPECT_EQ(model.region_threshold, 70);
  const Eigen::Matrix3d R = rotation_deg(-0.1, -0.8, 48.0);
  EXPECT_LT((vector(model.virtual_plane.normal()) - R.col(2)).norm(), 1e-6);
  EXPECT_LT((vector(model.virtual_plane.x_axis()) - R.col(0)).norm(), 1e-6);
}

TYPED_TEST(TrackingSetup, TakesItsOwnThresholdForZero) {
  this->scene_.settings->edges = {0, 70};
  ASSERT_TRUE(this->make().has_value());
  EXPECT_EQ(this->scene_.model.initial_threshold, 200);
  EXPECT_EQ(this->scene_.model.region_threshold, 70);
  this->scene_.settings->edges = {300, 0};
  ASSERT_TRUE(this->make().has_value());
  EXPECT_EQ(this->scene_.model.initial_threshold, 300);
  EXPECT_EQ(this->scene_.model.region_threshold, 0);
}

TYPED_TEST(TrackingSetup, RefusesATipBeyondTheFormat) {
  this->scene_.settings->tool.position_mm[1] = 1000.0;
  this->expect(Error::kOutOfRange);
  this->scene_.settings->tool.position_mm[1] = std::numeric_limits<double>::quiet_NaN();
  this->expect(Error::kOutOfRange);
}

TYPED_TEST(TrackingSetup, RefusesLimitsOfMotionBeyondTheFormat) {
  for (const MotionSettings& motion : {MotionSettings{0.0, 3000.0}, MotionSettings{2001.0, 3000.0},
                                       MotionSettings{300.0, 0.0}, MotionSettings{300.0, 1.1e6}}) {
    this->scene_.settings->motion = motion;
    this->expect(Error::kOutOfRange);
  }
}

TYPED_TEST(TrackingSetup, PassesTheLatticesAndTheCamerasErrorsOn) {
  this->scene_.settings->tubesheet.column_step_mm = {0.1, 25.4};
  this->expect(Error::kIllConditioned);
  this->scene_.settings->tubesheet.column_step_mm = {25.4, 0.0};
  this->scene_.settings->camera.cell_width_mm = 0.0;
  this->expect(Error::kOutOfRange);
}

TEST(MakeStartClicks, KeepsAddressesAndPlaces) {
  StaticVector<StartPoint, kMaxStartPoints> points;
  ASSERT_TRUE(points.try_push_back({{40, -60}, {313.5, 196.25}}));
  const StartClickList clicks = make_start_clicks(points);
  ASSERT_EQ(clicks.size(), 1);
  EXPECT_EQ(clicks[0].address, (TubeAddress{40, -60}));
  EXPECT_EQ(clicks[0].u_q16, 313 * 65536 + 32768);
  EXPECT_EQ(clicks[0].v_q16, 196 * 65536 + 16384);
}

TEST(MakeImagePoint, IsIn65536thsOfAPixel) {
  const ImagePoint point = make_image_point({1.5, -2.25});
  EXPECT_EQ(point.u_q16, 98304);
  EXPECT_EQ(point.v_q16, -147456);
}

}  // namespace
}  // namespace tubesight::core::tracking
