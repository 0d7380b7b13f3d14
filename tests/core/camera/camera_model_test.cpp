#include "core/camera/camera_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "core/camera/camera_setup.h"
#include "tests/core/camera/camera_test_support.h"
#include "tests/support/scalars.h"

namespace tubesight::core::camera {
namespace {

template <typename S>
class CameraModelTest : public ::testing::Test {
 protected:
  void SetUp() override { static_cast<void>(take_overflow_flag()); }
  void TearDown() override { EXPECT_FALSE(take_overflow_flag()); }
};

using tests::Scalars;
TYPED_TEST_SUITE(CameraModelTest, Scalars);

// Numbers that make Eq. 4.5-4.9 easy by hand: a frame cell is 0.01 / 1.2 * 600 / 500 = 0.01 mm wide
// and 0.0125 mm high, EFL = 5 mm: 500 and 400 px per unit of the plane.
CameraSettings hand_camera() {
  CameraSettings settings;
  settings.width_px = 320;
  settings.height_px = 240;
  settings.focal_length_mm = 5.0;
  settings.cell_width_mm = 0.01;
  settings.cell_height_mm = 0.0125;
  settings.sensor_columns = 600;
  settings.frame_columns = 500;
  settings.horizontal_scale = 1.2;
  settings.center_px = {100.0, 50.0};
  settings.distortion_per_mm2 = 0.008;
  return settings;
}

template <typename S>
CameraModel<S> model_of(const CameraSettings& settings) {
  const Result<CameraModel<S>> model = make_camera_model<S>(settings);
  EXPECT_TRUE(model.has_value());
  return model.value_or(CameraModel<S>());
}

template <typename S>
void expect_pair(const CameraSettings& settings, Vector2<double> pixel, Vector2<double> plane) {
  const CameraModel<S> model = model_of<S>(settings);
  const auto to_plane = model.to_plane({Px<S>(pixel.x), Px<S>(pixel.y)});
  const double plane_bound = bound_of<S>({1e-15, 1.5e-7, 2e-8});
  EXPECT_NEAR(static_cast<double>(to_plane.x), plane.x, plane_bound);
  EXPECT_NEAR(static_cast<double>(to_plane.y), plane.y, plane_bound);
  const auto to_pixel = model.to_pixel({Ratio<S>(plane.x), Ratio<S>(plane.y)});
  ASSERT_TRUE(to_pixel.has_value());
  const double pixel_bound = bound_of<S>({1e-9, 1e-4, 3e-5});
  EXPECT_NEAR(static_cast<double>(to_pixel->x), pixel.x, pixel_bound);
  EXPECT_NEAR(static_cast<double>(to_pixel->y), pixel.y, pixel_bound);
}

TYPED_TEST(CameraModelTest, FollowsTheSourceByHand) {
  // x_d = 0.01 * 100 = 1, y_d = 0.0125 * 80 = 1, r^2 = 2, factor 1 + 0.008 * 2 = 1.016:
  // (x_c, y_c) = (1.016, 1.016) mm, / 5 mm.
  expect_pair<TypeParam>(hand_camera(), {200, 130}, {0.2032, 0.2032});
  // x_d = -1, y_d = -0.5, r^2 = 1.25, factor 1.01: (-1.01, -0.505) mm.
  expect_pair<TypeParam>(hand_camera(), {0, 10}, {-0.202, -0.101});
  expect_pair<TypeParam>(hand_camera(), {100, 50}, {0, 0});
}

TYPED_TEST(CameraModelTest, FollowsTheSecondCoefficientByHand) {
  CameraSettings settings = hand_camera();
  settings.distortion2_per_mm4 = 0.001;  // factor 1 + 0.008 * 2 + 0.001 * 4 = 1.02
  expect_pair<TypeParam>(settings, {200, 130}, {0.204, 0.204});
}

TYPED_TEST(CameraModelTest, FollowsPinCushionDistortionByHand) {
  CameraSettings settings = hand_camera();
  settings.distortion_per_mm2 = -0.02;  // factor 1 - 0.02 * 2 = 0.96: drawn in, not out
  expect_pair<TypeParam>(settings, {200, 130}, {0.192, 0.192});
}

TYPED_TEST(CameraModelTest, FollowsTheSourcesCameraInItsCorner) {
  // python3: w = 0.0084 / 1.021 * 768 / 635; x = w * (0 - 324.3); y = 0.0098 * (0 - 233.8)
  // f = 1 + 0.0092 * (x * x + y * y); x * f / 5.06, y * f / 5.06
  expect_pair<TypeParam>(source_camera(), {0, 0}, {-0.7296264131979919, -0.5180636757609998});
}

// Eq. 4.5-4.9 written out, without the mirrored sensor's minus signs, in the widest arithmetic.
struct Ideal {
  explicit Ideal(const CameraSettings& s)
      : u0(s.center_px[0]),
        v0(s.center_px[1]),
        width_mm(static_cast<long double>(s.cell_width_mm) / s.horizontal_scale * s.sensor_columns /
                 s.frame_columns),
        height_mm(s.cell_height_mm),
        efl_mm(s.focal_length_mm),
        k(s.distortion_per_mm2),
        k2(s.distortion2_per_mm4) {}
  Vector2<long double> plane(double u, double v) const {
    const long double x_d = width_mm * (u - u0);
    const long double y_d = height_mm * (v - v0);
    const long double r2 = x_d * x_d + y_d * y_d;
    const long double factor = 1 + k * r2 + k2 * r2 * r2;
    return {x_d * factor / efl_mm, y_d * factor / efl_mm};
  }
  long double u0, v0, width_mm, height_mm, efl_mm, k, k2;
};

struct Worst {
  double plane_px = 0.0;  // of to_plane, times the scale
  double pixel_px = 0.0;  // of to_pixel
  int empty = 0;
};

double larger(double so_far, long double error) {
  return std::max(so_far, static_cast<double>(std::abs(error)));
}

// Both directions over the whole picture, its last line and column included.
template <typename S>
Worst worst_over(const CameraSettings& settings, double step_px) {
  const CameraModel<S> model = model_of<S>(settings);
  const Ideal ideal(settings);
  Worst worst;
  const double right = settings.width_px - 1;
  const double bottom = settings.height_px - 1;
  for (double v = 0; v < bottom + step_px; v += step_px) {
    for (double u = 0; u < right + step_px; u += step_px) {
      // A sixteenth is exact in every format.
      const double at_u = std::min(std::floor(u * 16) / 16, right);
      const double at_v = std::min(std::floor(v * 16) / 16, bottom);
      const auto exact = ideal.plane(at_u, at_v);
      const auto plane = model.to_plane({Px<S>(at_u), Px<S>(at_v)});
      const long double per_u = ideal.efl_mm / ideal.width_mm;
      const long double per_v = ideal.efl_mm / ideal.height_mm;
      worst.plane_px = larger(worst.plane_px, (static_cast<double>(plane.x) - exact.x) * per_u);
      worst.plane_px = larger(worst.plane_px, (static_cast<double>(plane.y) - exact.y) * per_v);
      const auto pixel = model.to_pixel(
          {Ratio<S>(static_cast<double>(exact.x)), Ratio<S>(static_cast<double>(exact.y))});
      if (!pixel) {
        ++worst.empty;
        continue;
      }
      worst.pixel_px = larger(worst.pixel_px, static_cast<double>(pixel->x) - at_u);
      worst.pixel_px = larger(worst.pixel_px, static_cast<double>(pixel->y) - at_v);
    }
  }
  return worst;
}

template <typename S>
void expect_within(const CameraSettings& settings, double step_px, const Bounds& bounds_px) {
  const Worst worst = worst_over<S>(settings, step_px);
  const double k = settings.distortion_per_mm2;
  EXPECT_EQ(worst.empty, 0) << "k " << k;
  EXPECT_LE(worst.plane_px, bound_of<S>(bounds_px)) << "k " << k;
  EXPECT_LE(worst.pixel_px, bound_of<S>(bounds_px)) << "k " << k;
}

// The bounds stand in camera_model.h.
constexpr Bounds kSmallPicture{1e-9, 2e-4, 3e-5};
constexpr Bounds kLargePicture{1e-9, 1e-3, 3e-5};

TYPED_TEST(CameraModelTest, IsAsExactAsStatedOverTheWholePicture) {
  expect_within<TypeParam>(source_camera(), 1.0625, kSmallPicture);
}

TYPED_TEST(CameraModelTest, IsAsExactAsStatedForOtherDistortions) {
  CameraSettings settings = source_camera();
  const double efl2 = settings.focal_length_mm * settings.focal_length_mm;
  // -0.39 at the picture's corner is a slope of 1 - 3 * 0.39 * 0.634 = 0.26.
  for (const double k : {-0.39, -0.2, -0.05, 0.0, 0.05, 0.1, 0.35, 0.499}) {
    settings.distortion_per_mm2 = k / efl2;
    expect_within<TypeParam>(settings, 5.1875, kSmallPicture);
  }
}

TYPED_TEST(CameraModelTest, IsAsExactAsStatedWithTheSecondCoefficient) {
  CameraSettings settings = source_camera();
  for (const double k2 : {-0.0003, 0.0003}) {
    settings.distortion2_per_mm4 = k2;
    expect_within<TypeParam>(settings, 5.1875, kSmallPicture);
  }
}

TYPED_TEST(CameraModelTest, IsAsExactAsStatedOverALargePicture) {
  CameraSettings settings = large_camera();
  expect_within<TypeParam>(settings, 16.0625, kLargePicture);
  settings.distortion_per_mm2 = 0.499 / 64.0;
  expect_within<TypeParam>(settings, 32.0625, kLargePicture);
  settings.distortion_per_mm2 = -0.25 / 64.0;
  expect_within<TypeParam>(settings, 32.0625, kLargePicture);
}

TYPED_TEST(CameraModelTest, StaysUsefulUpToTheFold) {
  // Slope 1 - 3 * 0.499 * 0.634 = 0.05 in the corner: rounding grows twentyfold, answers remain.
  CameraSettings settings = source_camera();
  settings.distortion_per_mm2 = -0.499 / (5.06 * 5.06);
  expect_within<TypeParam>(settings, 3.0625, {1e-8, 1e-3, 3e-5});
}

TYPED_TEST(CameraModelTest, TakesOneStepWithinTheSourcesPicture) {
  const auto inverse = model_of<TypeParam>(source_camera()).parameters().inverse;
  EXPECT_LE(inverse.newton_steps, (std::is_same_v<TypeParam, double> ? 2 : 1));
}

TYPED_TEST(CameraModelTest, UndoesItselfFarOutsideThePicture) {
  using S = TypeParam;
  for (const double k : {0.0, 0.0092, -0.004}) {
    CameraSettings settings = source_camera();
    settings.distortion_per_mm2 = k;
    const CameraModel<S> model = model_of<S>(settings);
    const Ideal ideal(settings);
    int found = 0;
    for (double R = 0.05; R < 1.79; R += 0.01) {
      const auto pixel = model.to_pixel({Ratio<S>(R * 0.8), Ratio<S>(R * -0.6)});
      if (!pixel) {
        continue;
      }
      ++found;
      const auto back = ideal.plane(static_cast<double>(pixel->x), static_cast<double>(pixel->y));
      // Barrel distortion compresses: a step of a pixel is up to four of the plane.
      const double bound = bound_of<S>({1e-9, 2e-6, 3e-7});
      ASSERT_NEAR(static_cast<double>(back.x), R * 0.8, bound) << R;
      ASSERT_NEAR(static_cast<double>(back.y), R * -0.6, bound) << R;
    }
    // Pin-cushion: the mapping turns back at r^2 = 1 / (3 * 0.1024), R = 1.203.
    EXPECT_GE(found, k < 0.0 ? 113 : 174);
    EXPECT_LE(found, k < 0.0 ? 116 : 174);
  }
}

TYPED_TEST(CameraModelTest, IsEmptyOutsideItsDomain) {
  using S = TypeParam;
  const CameraModel<S> model = model_of<S>(source_camera());
  EXPECT_TRUE(model.to_pixel({Ratio<S>(1.79), Ratio<S>(0)}).has_value());
  const Vector2<double> outside[] = {{1.81, 0}, {0, -1.81}, {1.3, 1.3}, {3.9, 3.9}, {-4, -4}};
  for (const auto& point : outside) {
    EXPECT_FALSE(model.to_pixel({Ratio<S>(point.x), Ratio<S>(point.y)}).has_value()) << point.x;
  }
  // absolute(-4) saturates: the flag is the price of a point that far out of range.
  static_cast<void>(take_overflow_flag());
}

// A narrow view has small radii on the plane and, with the distortion of a short lens' sensor,
// large derivatives by them.
TYPED_TEST(CameraModelTest, HasPatchesInNarrowViewsToo) {
  using S = TypeParam;
  for (const double efl : {5.0, 7.04, 9.0, 12.0, 16.0, 19.0}) {
    for (const double k : {-0.004, 0.0, 0.002, 0.005}) {
      CameraSettings settings;
      settings.width_px = 640;
      settings.height_px = 480;
      settings.focal_length_mm = efl;
      settings.cell_width_mm = 0.01;
      settings.cell_height_mm = 0.01;
      settings.sensor_columns = 640;
      settings.frame_columns = 640;
      settings.center_px = {314.6, 247.5};
      settings.distortion_per_mm2 = k;
      const CameraModel<S> model = model_of<S>(settings);
      const double rim = 0.3 / efl;  // 30 px
      for (const double u : {30.0, 300.0, 610.0}) {
        for (const double v : {30.0, 240.0, 450.0}) {
          const auto middle = model.to_plane({Px<S>(u), Px<S>(v)});
          const auto patch = model.patch_at(middle);
          ASSERT_TRUE(patch.has_value()) << efl << ", " << k;
          for (const auto& [x, y] : {std::pair{rim, 0.0}, {-rim, 0.0}, {0.0, rim}, {0.0, -rim}}) {
            const Vector2<Ratio<S>> point{middle.x + Ratio<S>(x), middle.y + Ratio<S>(y)};
            const auto exact = model.to_pixel(point);
            ASSERT_TRUE(exact.has_value()) << efl << ", " << k;
            const auto near = model.to_pixel(point, *patch);
            EXPECT_NEAR(static_cast<double>(near.x), static_cast<double>(exact->x), 0.02)
                << efl << ", " << k << " at " << u << ", " << v;
            EXPECT_NEAR(static_cast<double>(near.y), static_cast<double>(exact->y), 0.02)
                << efl << ", " << k << " at " << u << ", " << v;
          }
        }
      }
    }
  }
}

TYPED_TEST(CameraModelTest, IsEmptyWhereThePictureFoldsOver) {
  using S = TypeParam;
  CameraSettings settings = source_camera();
  settings.distortion_per_mm2 = -0.45 / (5.06 * 5.06);
  const CameraModel<S> model = model_of<S>(settings);
  // Largest R: r^2 = 1 / 1.35, R = r * 2 / 3 = 0.5738.
  EXPECT_TRUE(model.to_pixel({Ratio<S>(0.56), Ratio<S>(0)}).has_value());
  for (const double R : {0.58, 0.7, 1.0, 1.5, 1.79}) {
    EXPECT_FALSE(model.to_pixel({Ratio<S>(R), Ratio<S>(0)}).has_value()) << R;
  }
}

TYPED_TEST(CameraModelTest, IsEmptyBeforeItIsMade) {
  using S = TypeParam;
  EXPECT_FALSE(CameraModel<S>().to_pixel({Ratio<S>(0.1), Ratio<S>(0)}).has_value());
}

}  // namespace
}  // namespace tubesight::core::camera
