#include "core/tracking/rim_outline.h"

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

constexpr double kPi = 3.14159265358979323846;

template <typename S>
class RimOutlineOf : public ::testing::Test {
 protected:
  void SetUp() override { scene_.make(); }

  [[nodiscard]] std::optional<RimOutline<S>> outline(const SyntheticSheet& sheet,
                                                     TubeAddress tube) const {
    const auto pose = pose_at<S>(*scene_.settings, sheet, kOverTube, kTube);
    const auto spokes = make_rim_spokes<S>(pose, scene_.model.bore_radius_mm);
    return project_rim<S>(
        scene_.model, pose.origin + pose.along(scene_.model.lattice.offset(kTube, tube)), spokes);
  }

  // A point of the true rim's image.
  [[nodiscard]] static std::array<double, 2> rim_point(const SyntheticSheet& sheet,
                                                       TubeAddress tube, double angle) {
    const auto center = sheet.center_of(tube);
    return sheet.image_of(
        kOverTube, {center[0] + 9.3 * std::cos(angle), center[1] + 9.3 * std::sin(angle), 0.0});
  }

  Scene<S> scene_;
};
TYPED_TEST_SUITE(RimOutlineOf, Scalars);

const std::array<TubeAddress, 4> kSeen{{{20, 10}, {21, 11}, {19, 9}, {22, 10}}};

TYPED_TEST(RimOutlineOf, LiesOnTheDenselyProjectedCircle) {
  const SyntheticSheet sheet(*this->scene_.settings);
  for (const TubeAddress tube : kSeen) {
    const auto rim = this->outline(sheet, tube);
    ASSERT_TRUE(rim.has_value());
    for (int k = 0; k < kRimPoints; ++k) {
      const auto expected = this->rim_point(sheet, tube, 2.0 * kPi * k / kRimPoints);
      EXPECT_LT(distance(rim->points[static_cast<std::size_t>(k)], expected),
                0.02)  // ten times less than one edge point is known
          << "point " << k;
    }
  }
}

TYPED_TEST(RimOutlineOf, KnowsItsTangents) {
  const SyntheticSheet sheet(*this->scene_.settings);
  const double h = 1e-4;
  for (const TubeAddress tube : kSeen) {
    const auto rim = this->outline(sheet, tube);
    ASSERT_TRUE(rim.has_value());
    for (int k = 0; k < kRimPoints; ++k) {
      const double angle = 2.0 * kPi * k / kRimPoints;
      const auto ahead = this->rim_point(sheet, tube, angle + h);
      const auto behind = this->rim_point(sheet, tube, angle - h);
      const std::array<double, 2> tangent{(ahead[0] - behind[0]) / (2 * h),
                                          (ahead[1] - behind[1]) / (2 * h)};
      const double length = std::hypot(tangent[0], tangent[1]);
      EXPECT_LT(distance(rim->tangent(k), tangent), 0.03 * length) << "point " << k;
    }
  }
}

TYPED_TEST(RimOutlineOf, HasTheCirclesBox) {
  const SyntheticSheet sheet(*this->scene_.settings);
  for (const TubeAddress tube : kSeen) {
    const auto rim = this->outline(sheet, tube);
    ASSERT_TRUE(rim.has_value());
    std::array<double, 2> least{1e9, 1e9};
    std::array<double, 2> most{-1e9, -1e9};
    for (int i = 0; i < 3600; ++i) {
      const auto point = this->rim_point(sheet, tube, kPi * i / 1800.0);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        least[axis] = std::min(least[axis], point[axis]);
        most[axis] = std::max(most[axis], point[axis]);
      }
    }
    // The extreme points of the true rim lie up to half a step from the outline's.
    const double cut = 1.0 - std::cos(kPi / kRimPoints);
    EXPECT_NEAR(number(rim->half_extent.x), (most[0] - least[0]) / 2,
                (cut + 0.01) * (most[0] - least[0]) / 2);
    EXPECT_NEAR(number(rim->half_extent.y), (most[1] - least[1]) / 2,
                (cut + 0.01) * (most[1] - least[1]) / 2);
    EXPECT_NEAR(number(rim->middle.x), (most[0] + least[0]) / 2, 1.0);
    EXPECT_NEAR(number(rim->middle.y), (most[1] + least[1]) / 2, 1.0);
  }
}

TYPED_TEST(RimOutlineOf, HasAMiddleThatIsNotTheCentresImage) {
  // The bias that measure_tube() has to avoid: the outline's centre lies beside the image of the
  // circle's centre wherever the sheet is seen aslant.
  const SyntheticSheet sheet(*this->scene_.settings);
  double most = 0.0;
  for (const TubeAddress tube : kSeen) {
    const auto rim = this->outline(sheet, tube);
    ASSERT_TRUE(rim.has_value());
    most = std::max(most, distance(rim->middle, sheet.image_of(kOverTube, tube)));
  }
  EXPECT_GT(most, 0.5);
}

TYPED_TEST(RimOutlineOf, IsEmptyWhereThePlaneLeavesTheView) {
  const SyntheticSheet sheet(*this->scene_.settings);
  EXPECT_FALSE(this->outline(sheet, {20, 60}).has_value());
}

}  // namespace
}  // namespace tubesight::core::tracking
