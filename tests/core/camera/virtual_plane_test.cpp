#include "core/camera/virtual_plane.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/camera/camera_setup.h"
#include "tests/core/camera/camera_test_support.h"
#include "tests/support/scalars.h"

namespace tubesight::core::camera {
namespace {

using T_CameraTool = Transform<frames::Camera, frames::Tool>;

template <typename S>
class VirtualPlaneTest : public ::testing::Test {
 protected:
  void SetUp() override { static_cast<void>(take_overflow_flag()); }
  void TearDown() override { EXPECT_FALSE(take_overflow_flag()); }
};

using tests::Scalars;
TYPED_TEST_SUITE(VirtualPlaneTest, Scalars);

// Worst errors of the two directions; they stand in virtual_plane.h.
constexpr Bounds kFromImage{1e-14, 2e-6, 6e-7};
constexpr Bounds kToImage{1e-14, 5e-7, 1.5e-6};

// Mountings: the source's, straight, turned by quarter turns, leaning.
const std::array<std::array<double, 3>, 8> kMountings_deg{{{-0.0639, -0.8174, 47.9947},
                                                           {0, 0, 0},
                                                           {90, 0, 0},
                                                           {180, 0, 0},
                                                           {-90, 0, 0},
                                                           {90, 20, -30},
                                                           {-93, -15, 25},
                                                           {37, 30, 40}}};

template <typename S>
Vector2<Ratio<S>> image_point(double x, double y) {
  return {Ratio<S>(x), Ratio<S>(y)};
}

TYPED_TEST(VirtualPlaneTest, FollowsASimpleCaseByHand) {
  using S = TypeParam;
  // Tilted about y with sine 0.6 and cosine 0.8. Ray (0.5, 0.25, 1): along the normal 0.3 + 0.8 =
  // 1.1, along x 0.4 - 0.6 = -0.2, along y 0.25; divided by 1.1.
  const VirtualPlane<S> plane({Unit<S>(0.8), Unit<S>(0), Unit<S>(-0.6)},
                              {Unit<S>(0), Unit<S>(1), Unit<S>(0)},
                              {Unit<S>(0.6), Unit<S>(0), Unit<S>(0.8)});
  const auto point = plane.from_image(image_point<S>(0.5, 0.25));
  ASSERT_TRUE(point.has_value());
  EXPECT_NEAR(static_cast<double>(point->x), -2.0 / 11.0, bound_of<S>(kFromImage));
  EXPECT_NEAR(static_cast<double>(point->y), 2.5 / 11.0, bound_of<S>(kFromImage));
  // (1, 2) is 1 * (0.8, 0, -0.6) + 2 * (0, 1, 0) + (0.6, 0, 0.8) = (1.4, 2, 0.2): too far off;
  // (-0.5, 0.5): (0.2, 0.5, 1.1).
  EXPECT_FALSE(plane.to_image({Mm<S>(1), Mm<S>(2)}).has_value());
  const auto image = plane.to_image({Mm<S>(-0.5), Mm<S>(0.5)});
  ASSERT_TRUE(image.has_value());
  EXPECT_NEAR(static_cast<double>(image->x), 2.0 / 11.0, bound_of<S>(kToImage));
  EXPECT_NEAR(static_cast<double>(image->y), 5.0 / 11.0, bound_of<S>(kToImage));
}

// [Fallon eq. 6.8-6.10] in the source's own frame: the plane through (0, 0, EFL).
Eigen::Vector3d rvip_point(const Eigen::Vector3d& N, double efl, double X_vip, double Y_vip) {
  const double Z = N[2] * efl * efl / (N[0] * X_vip + N[1] * Y_vip + N[2] * efl);
  return {Z / efl * X_vip, Z / efl * Y_vip, Z};
}

TYPED_TEST(VirtualPlaneTest, AgreesWithTheSourcesFormulas) {
  using S = TypeParam;
  constexpr double kEfl = 5.06;
  for (const auto& angles_deg : kMountings_deg) {
    const T_CameraTool T_camera_tool(rotation_from_degrees(angles_deg), {0, 0, 0});
    const VirtualPlane<S> plane = make_virtual_plane<S>(T_camera_tool);
    const Eigen::Vector3d N = T_camera_tool.rotation().col(2);
    for (double x = -0.75; x <= 0.76; x += 0.25) {
      for (double y = -0.5; y <= 0.51; y += 0.125) {
        const Eigen::Vector3d P = rvip_point(N, kEfl, kEfl * x, kEfl * y);
        ASSERT_NEAR(N.dot(P), N[2] * kEfl, 1e-12) << "not on the plane of eq. 6.5";
        const auto point = plane.from_image(image_point<S>(x, y));
        if (N.dot(Eigen::Vector3d(x, y, 1.0)) < 0.3) {
          continue;  // rays that graze the plane: below
        }
        ASSERT_TRUE(point.has_value());
        // Ours is the source's divided by N_2 EFL, in the tool's directions.
        const double scale = N[2] * kEfl;
        const double bound = bound_of<S>(kFromImage);
        ASSERT_NEAR(static_cast<double>(point->x), T_camera_tool.rotation().col(0).dot(P) / scale,
                    bound);
        ASSERT_NEAR(static_cast<double>(point->y), T_camera_tool.rotation().col(1).dot(P) / scale,
                    bound);
        // [Fallon eq. 6.12-6.14]: X_vip = EFL / Z_rvip X_rvip.
        const auto image = plane.to_image(*point);
        ASSERT_TRUE(image.has_value());
        const double trip = bound_of<S>(kToImage) * 2.0;  // the point's own rounding comes on top
        ASSERT_NEAR(static_cast<double>(image->x), P[0] / P[2], trip);
        ASSERT_NEAR(static_cast<double>(image->y), P[1] / P[2], trip);
      }
    }
  }
}

TYPED_TEST(VirtualPlaneTest, SeesALevelLatticeEquallySpaced) {
  using S = TypeParam;
  constexpr double kPitch_mm = 25.4;
  for (const auto& angles_deg : kMountings_deg) {
    const Eigen::Matrix3d R = rotation_from_degrees(angles_deg);
    // The sheet stands 180 mm along the guidetube axis from the camera, whichever way it looks.
    const VirtualPlane<S> plane = make_virtual_plane<S>(T_CameraTool(R, {0, 0, 0}));
    const double depth_mm = 180.0;
    const Eigen::Vector3d middle = Eigen::Vector3d(0, 0, 1) * depth_mm / R(2, 2);
    const auto seen = [&](int row, int column) {
      const Eigen::Vector3d P =
          middle + R.col(0) * (column * kPitch_mm) + R.col(1) * (row * kPitch_mm);
      return plane.from_image(image_point<S>(P[0] / P[2], P[1] / P[2]));
    };
    const auto origin = seen(0, 0);
    ASSERT_TRUE(origin.has_value());
    const double spacing = kPitch_mm / depth_mm;
    for (int row = -2; row <= 2; ++row) {
      for (int column = -2; column <= 2; ++column) {
        const auto point = seen(row, column);
        ASSERT_TRUE(point.has_value());
        const auto step = *point - *origin;
        const double bound = bound_of<S>(kFromImage) * 2.0;  // two points
        EXPECT_NEAR(static_cast<double>(step.x), column * spacing, bound);
        EXPECT_NEAR(static_cast<double>(step.y), row * spacing, bound);
      }
    }
  }
}

TYPED_TEST(VirtualPlaneTest, DrawsATurnedCameraThePointsTurned) {
  using S = TypeParam;
  const T_CameraTool straight(rotation_from_degrees({0, 20, 10}), {0, 0, 0});
  const T_CameraTool turned(rotation_from_degrees({90, 20, 10}), {0, 0, 0});
  const auto plane = make_virtual_plane<S>(straight);
  const auto plane_turned = make_virtual_plane<S>(turned);
  // A camera turned by -90 degrees sees (x, y) at (-y, x); the plane's points stay.
  const auto a = plane.from_image(image_point<S>(0.25, -0.375));
  const auto b = plane_turned.from_image(image_point<S>(0.375, 0.25));
  ASSERT_TRUE(a.has_value());
  ASSERT_TRUE(b.has_value());
  EXPECT_NEAR(static_cast<double>(a->x), static_cast<double>(b->x), 2 * bound_of<S>(kFromImage));
  EXPECT_NEAR(static_cast<double>(a->y), static_cast<double>(b->y), 2 * bound_of<S>(kFromImage));
}

TYPED_TEST(VirtualPlaneTest, IsEmptyForRaysAlongThePlaneOrAwayFromIt) {
  using S = TypeParam;
  // Normal (0.8, 0, 0.6): the ray (x, 0, 1) has depth 0.8 x + 0.6; 0.125 at x = -0.59375.
  const VirtualPlane<S> plane({Unit<S>(0.6), Unit<S>(0), Unit<S>(-0.8)},
                              {Unit<S>(0), Unit<S>(1), Unit<S>(0)},
                              {Unit<S>(0.8), Unit<S>(0), Unit<S>(0.6)});
  EXPECT_TRUE(plane.from_image(image_point<S>(-0.59, 0)).has_value());
  EXPECT_FALSE(plane.from_image(image_point<S>(-0.60, 0)).has_value());
  EXPECT_FALSE(plane.from_image(image_point<S>(-1.5, 0)).has_value());
}

TYPED_TEST(VirtualPlaneTest, IsEmptyForPointsBesideOrBehindTheCamera) {
  using S = TypeParam;
  const auto straight = make_virtual_plane<S>(T_CameraTool());
  EXPECT_TRUE(straight.to_image({Mm<S>(1.79), Mm<S>(-1.79)}).has_value());
  EXPECT_FALSE(straight.to_image({Mm<S>(1.81), Mm<S>(0)}).has_value());
  EXPECT_FALSE(straight.to_image({Mm<S>(0), Mm<S>(-1.81)}).has_value());
  EXPECT_FALSE(straight.to_image({Mm<S>(1000), Mm<S>(-1000)}).has_value());
  const T_CameraTool facing_back(rotation_from_degrees({0, 180, 0}), {0, 0, 0});
  const auto behind = make_virtual_plane<S>(facing_back);
  EXPECT_FALSE(behind.to_image({Mm<S>(0), Mm<S>(0)}).has_value());
  EXPECT_FALSE(behind.from_image(image_point<S>(0, 0)).has_value());
}

}  // namespace
}  // namespace tubesight::core::camera
