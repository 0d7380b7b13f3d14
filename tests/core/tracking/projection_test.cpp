#include "core/tracking/projection.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/base/overflow.h"
#include "core/tracking/candidates.h"
#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class Projection : public ::testing::Test {
 protected:
  void SetUp() override { scene_.make(); }

  Scene<S> scene_;
};
TYPED_TEST_SUITE(Projection, Scalars);

const std::array<ToolPlace, 4> kPlaces{{{254.0, 508.0, 60.0, 2.0, 0.0, 0.0},
                                        {250.0, 510.0, 0.0, 90.0, 0.0, 0.0},
                                        {260.0, 500.0, 90.0, -137.0, 0.9, -0.7},
                                        {254.0, 508.0, 30.0, 181.0, -1.0, 1.0}}};

TYPED_TEST(Projection, PutsTubesWhereThePictureHasThem) {
  const SyntheticSheet sheet(*this->scene_.settings);
  int inside = 0;
  for (const ToolPlace& place : kPlaces) {
    const auto pose = pose_at<TypeParam>(*this->scene_.settings, sheet, place, kTube);
    for (std::int32_t row = -3; row <= 3; ++row) {
      for (std::int32_t column = -3; column <= 3; ++column) {
        const TubeAddress tube{kTube.row + row, kTube.column + column};
        const auto expected = sheet.image_of(place, tube);
        if (expected[0] < 0 || expected[0] > 634 || expected[1] < 0 || expected[1] > 479) {
          continue;
        }
        ++inside;
        const auto pixel = project<TypeParam>(this->scene_.model, pose,
                                              this->scene_.model.lattice.offset(kTube, tube));
        ASSERT_TRUE(pixel.has_value());
        EXPECT_LT(distance(*pixel, expected), bound<TypeParam>(1e-7, 1e-3, 3e-4))
            << row << ", " << column;
      }
    }
  }
  EXPECT_GT(inside, 40);
}

TYPED_TEST(Projection, ShowsThePointOfTheSheetThatAPixelLooksAt) {
  const SyntheticSheet sheet(*this->scene_.settings);
  for (const ToolPlace& place : kPlaces) {
    const auto pose = pose_at<TypeParam>(*this->scene_.settings, sheet, place, kTube);
    const auto center = sheet.center_of(kTube);
    for (double u = 0; u < 635; u += 45) {
      for (double v = 0; v < 480; v += 37) {
        const auto expected = sheet.sheet_point(place, {u, v});
        if (!expected || std::hypot((*expected)[0] - center[0], (*expected)[1] - center[1]) > 500) {
          continue;
        }
        const auto point =
            to_sheet<TypeParam>(this->scene_.model, pose, {Px<TypeParam>(u), Px<TypeParam>(v)});
        ASSERT_TRUE(point.has_value()) << u << ", " << v;
        EXPECT_LT(distance(*point, {(*expected)[0] - center[0], (*expected)[1] - center[1]}),
                  bound<TypeParam>(1e-6, 3e-3, 1e-3))
            << u << ", " << v;
      }
    }
  }
}

TYPED_TEST(Projection, ThereAndBackIsTheSamePixel) {
  const SyntheticSheet sheet(*this->scene_.settings);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> column(20.0, 615.0);
  std::uniform_real_distribution<double> line(20.0, 400.0);
  for (const ToolPlace& place : kPlaces) {
    const auto pose = pose_at<TypeParam>(*this->scene_.settings, sheet, place, kTube);
    for (int i = 0; i < 100; ++i) {
      const double u = column(random);
      const double v = line(random);
      const auto point =
          to_sheet<TypeParam>(this->scene_.model, pose, {Px<TypeParam>(u), Px<TypeParam>(v)});
      ASSERT_TRUE(point.has_value());
      const auto pixel = project<TypeParam>(this->scene_.model, pose, *point);
      ASSERT_TRUE(pixel.has_value());
      EXPECT_LT(distance(*pixel, {u, v}), bound<TypeParam>(1e-7, 2e-3, 5e-4));
    }
  }
}

TYPED_TEST(Projection, RefusesWhatTheCameraCannotSee) {
  using M = Mm<TypeParam>;
  EXPECT_FALSE(to_plane<TypeParam>({M(0), M(0), M(7.9)}).has_value()) << "too near";
  EXPECT_FALSE(to_plane<TypeParam>({M(0), M(0), M(-100)}).has_value()) << "behind";
  EXPECT_FALSE(to_plane<TypeParam>({M(210), M(0), M(100)}).has_value()) << "64 degrees off";
  EXPECT_FALSE(to_plane<TypeParam>({M(0), M(-210), M(100)}).has_value());
  const auto plane = to_plane<TypeParam>({M(50), M(-25), M(200)});
  ASSERT_TRUE(plane.has_value());
  EXPECT_NEAR(number(plane->x), 0.25, 1e-6);
  EXPECT_NEAR(number(plane->y), -0.125, 1e-6);
}

TYPED_TEST(Projection, HoldsForPointsBeyondAMetre) {
  using M = Mm<TypeParam>;
  static_cast<void>(take_overflow_flag());
  const auto plane = to_plane<TypeParam>({M(-700.0), M(1400.0), M(1400.0)});
  ASSERT_TRUE(plane.has_value());
  EXPECT_NEAR(number(plane->x), -0.5, 1e-6);
  EXPECT_NEAR(number(plane->y), 1.0, 1e-6);
  EXPECT_FALSE(to_plane<TypeParam>({M(-2040.0), M(0.0), M(1000.0)}).has_value());
  EXPECT_TRUE(to_plane<TypeParam>({M(2040.0), M(-2040.0), M(2040.0)}).has_value());
  EXPECT_FALSE(take_overflow_flag());
}

TYPED_TEST(Projection, FindsNoSheetFarAsideAndRaisesNothing) {
  // A sheet that tilts away by 55 degrees, 850 mm along the axis, and a view of a hundred degrees:
  // what the numbers cannot hold is not there.
  this->scene_.settings->camera.focal_length_mm = 2.4;
  this->scene_.settings->camera.distortion_per_mm2 = 0.0;
  this->scene_.make();
  const double tilt = 55.0 * M_PI / 180.0;
  using U = Unit<TypeParam>;
  using M = Mm<TypeParam>;
  for (const double sense : {-1.0, 1.0}) {
    SheetPose<TypeParam> pose;
    pose.x_axis = {U(1), U(0), U(0)};
    pose.y_axis = {U(0), U(std::cos(tilt)), U(sense * std::sin(tilt))};
    pose.normal = {U(0), U(-sense * std::sin(tilt)), U(std::cos(tilt))};
    pose.origin = {M(0), M(0), M(850)};
    static_cast<void>(take_overflow_flag());
    int found = 0;
    for (int u = 0; u <= 630; u += 30) {
      for (int v = 0; v <= 475; v += 25) {
        found += to_sheet<TypeParam>(this->scene_.model, pose, {Px<TypeParam>(u), Px<TypeParam>(v)})
                         .has_value()
                     ? 1
                     : 0;
      }
    }
    EXPECT_GT(found, 100);
    EXPECT_LT(found, 22 * 20);
    EXPECT_FALSE(take_overflow_flag());
    CandidateList<TypeParam> list;
    list_candidates<TypeParam>(this->scene_.model, *this->scene_.map, pose, list);
    EXPECT_GT(list.size(), 10);
    EXPECT_FALSE(take_overflow_flag());
  }
}

TYPED_TEST(Projection, FindsNoSheetWhereARayRunsAlongItOrAway) {
  // A sheet seen edge on: its normal is the camera's x axis, so rays of the left half run away.
  using U = Unit<TypeParam>;
  using M = Mm<TypeParam>;
  SheetPose<TypeParam> pose;
  pose.x_axis = {U(0), U(1), U(0)};
  pose.y_axis = {U(0), U(0), U(1)};
  pose.normal = {U(1), U(0), U(0)};
  pose.origin = {M(50), M(0), M(100)};
  const auto at = [&](double u, double v) {
    return to_sheet<TypeParam>(this->scene_.model, pose, {Px<TypeParam>(u), Px<TypeParam>(v)});
  };

  EXPECT_FALSE(at(100, 234).has_value()) << "away";
  EXPECT_FALSE(at(324.3, 234).has_value()) << "along";
  EXPECT_TRUE(at(600, 234).has_value());
}

}  // namespace
}  // namespace tubesight::core::tracking
