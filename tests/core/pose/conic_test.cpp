#include "core/pose/conic.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tubesight::core::pose {
namespace {

// (x - 2)^2 / 9 + (y + 1)^2 / 4 = 1, times 36: 4 x^2 + 9 y^2 - 16 x + 18 y - 11 = 0
Conic upright() {
  Eigen::Matrix<double, 6, 1> k;
  k << 4, 0, 9, -16, 18, -11;
  return conic_from(k);
}

TEST(ConicOfAnEllipse, KnowsItsCentreAndAxes) {
  const Conic conic = upright();

  const EllipseAxes axes = axes_of(conic);

  EXPECT_TRUE(is_ellipse(conic));
  EXPECT_TRUE(center_of(conic).isApprox(Eigen::Vector2d(2, -1)));
  EXPECT_NEAR(axes.major, 3.0, 1e-14);
  EXPECT_NEAR(axes.minor, 2.0, 1e-14);
  EXPECT_NEAR(std::abs(axes.direction.x()), 1.0, 1e-14);
}

TEST(ConicOfAnEllipse, TurnsWithItsCoordinates) {
  const double c = std::cos(0.5);
  const double s = std::sin(0.5);
  Eigen::Matrix3d back;  // p = R^T (p' - t) with t = (3, 4)
  back << c, s, -3 * c - 4 * s, -s, c, 3 * s - 4 * c, 0, 0, 1;

  for (const double sign : {1.0, -1.0}) {
    const Conic moved = transformed(sign * upright(), back);
    const EllipseAxes axes = axes_of(moved);

    const Eigen::Vector2d center(2 * c + s + 3, 2 * s - c + 4);
    EXPECT_TRUE(center_of(moved).isApprox(center)) << sign;
    EXPECT_NEAR(axes.major, 3.0, 1e-12);
    EXPECT_NEAR(axes.minor, 2.0, 1e-12);
    EXPECT_NEAR(std::abs(axes.direction.dot(Eigen::Vector2d(c, s))), 1.0, 1e-12);
  }
}

TEST(ConicOfAnEllipse, MeasuresDistancesOutwardsToFirstOrder) {
  EXPECT_NEAR(distance_to(upright(), {5.001, -1.0}), 0.001, 1e-6);
  EXPECT_NEAR(distance_to(upright(), {2.0, 0.999}), -0.001, 1e-6);
}

TEST(IsEllipse, RefusesEmptyPointAndHyperbola) {
  Conic empty = upright();
  empty(2, 2) += 100.0;
  Conic point = upright();
  point(2, 2) = 25.0;  // 4 (x - 2)^2 + 9 (y + 1)^2 = 0
  Conic hyperbola = upright();
  hyperbola(1, 1) = -9.0;

  EXPECT_FALSE(is_ellipse(empty));
  EXPECT_FALSE(is_ellipse(point));
  EXPECT_FALSE(is_ellipse(hyperbola));
  EXPECT_TRUE(is_ellipse(-upright()));
}

}  // namespace
}  // namespace tubesight::core::pose
