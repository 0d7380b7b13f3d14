#include "core/pose/ellipse_fit.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/synthetic_rims.h"

namespace tubesight::core::pose {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kPerPx = 1.0 / 520.0;  // plane units to a pixel
constexpr std::array<EllipseMethod, 4> kMethods = {EllipseMethod::kLinear, EllipseMethod::kDirect,
                                                   EllipseMethod::kTaubin, EllipseMethod::kSampson};

// An ellipse of 40 by 30 px about (0.2, -0.1), its longer axis 25 degrees up.
Eigen::Vector2d true_center() { return {0.2, -0.1}; }

Eigen::Vector2d ellipse_point(double angle) {
  const double a = 40.0 * kPerPx * std::cos(angle);
  const double b = 30.0 * kPerPx * std::sin(angle);
  const double c = std::cos(25.0 * kPi / 180.0);
  const double s = std::sin(25.0 * kPi / 180.0);
  return true_center() + Eigen::Vector2d(c * a - s * b, s * a + c * b);
}

std::vector<PlanePoint> points_of(int count, double arc, double noise_px,
                                  tests::Deviates& deviates) {
  std::vector<PlanePoint> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.3 + arc * i / count;
    const Eigen::Vector2d p = ellipse_point(angle);
    const Eigen::Vector2d tangent = ellipse_point(angle + 1e-4) - ellipse_point(angle - 1e-4);
    const Eigen::Vector2d normal = Eigen::Vector2d(tangent.y(), -tangent.x()).normalized();
    const Eigen::Vector2d q = p + noise_px * kPerPx * deviates.normal() * normal;
    PlanePoint point;
    point.x = q.x();
    point.y = q.y();
    point.x_u = kPerPx;
    point.y_v = kPerPx;
    point.weight = 100.0;
    points.push_back(point);
  }
  return points;
}

TEST(FitEllipse, FindsAnExactEllipseByEveryMethod) {
  tests::Deviates deviates(1);
  for (const EllipseMethod method : kMethods) {
    std::vector<PlanePoint> points = points_of(60, 2 * kPi, 0.0, deviates);

    const auto fit = fit_ellipse(points, {.method = method});

    ASSERT_TRUE(fit.has_value()) << static_cast<int>(method);
    const EllipseAxes axes = axes_of(fit->conic);
    EXPECT_LT((center_of(fit->conic) - true_center()).norm(), 1e-10);
    EXPECT_NEAR(axes.major, 40.0 * kPerPx, 1e-9);
    EXPECT_NEAR(axes.minor, 30.0 * kPerPx, 1e-9);
    EXPECT_GT(fit->conic(0, 0), 0.0);
    EXPECT_EQ(fit->points, 60);
  }
}

TEST(FitEllipse, FindsAnExactEllipseFromAThirdOfIt) {
  tests::Deviates deviates(1);
  for (const EllipseMethod method : kMethods) {
    std::vector<PlanePoint> points = points_of(40, 2 * kPi / 3, 0.0, deviates);

    const auto fit = fit_ellipse(points, {.method = method});

    ASSERT_TRUE(fit.has_value()) << static_cast<int>(method);
    EXPECT_LT((center_of(fit->conic) - true_center()).norm(), 1e-7) << static_cast<int>(method);
  }
}

TEST(FitEllipse, IsUnbiasedOnArcsByTheDefaultAndShrunkByTheDirectFit) {
  // Half an ellipse, 0.3 px: the mean of many fits shows what is no noise.
  Eigen::Vector2d off_default = Eigen::Vector2d::Zero();
  Eigen::Vector2d off_direct = Eigen::Vector2d::Zero();
  tests::Deviates deviates(7);
  constexpr int kFits = 400;
  for (int i = 0; i < kFits; ++i) {
    std::vector<PlanePoint> points = points_of(50, kPi, 0.3, deviates);
    const auto good = fit_ellipse(points, {.robust_rounds = 0});
    const auto direct = fit_ellipse(points, {.method = EllipseMethod::kDirect, .robust_rounds = 0});
    ASSERT_TRUE(good.has_value() && direct.has_value());
    off_default += (center_of(good->conic) - true_center()) / kPerPx / kFits;
    off_direct += (center_of(direct->conic) - true_center()) / kPerPx / kFits;
  }

  EXPECT_LT(off_default.norm(), 0.09);
  EXPECT_GT(off_direct.norm(), 0.18);
}

TEST(FitEllipse, LeavesOutliersOut) {
  tests::Deviates deviates(3);
  std::vector<PlanePoint> points = points_of(60, 2 * kPi, 0.05, deviates);
  for (std::size_t i = 10; i < 18; ++i) {  // a nick: eight points 3 px outwards
    points[i].x += 3.0 * kPerPx * (points[i].x - 0.2) / (35.0 * kPerPx);
    points[i].y += 3.0 * kPerPx * (points[i].y + 0.1) / (35.0 * kPerPx);
  }

  const auto robust = fit_ellipse(points, {});
  const auto plain = fit_ellipse(points, {.robust_rounds = 0});

  ASSERT_TRUE(robust.has_value() && plain.has_value());
  EXPECT_LT((center_of(robust->conic) - true_center()).norm() / kPerPx, 0.03);
  EXPECT_GT((center_of(plain->conic) - true_center()).norm() / kPerPx, 0.2);
  EXPECT_LE(robust->points, 52);
  EXPECT_LT(robust->rms_px, 0.08);
}

TEST(FitEllipse, PredictsWithheldPointsAsWellAsThoseItUsed) {
  tests::Deviates deviates(4);
  std::vector<PlanePoint> points = points_of(100, 2 * kPi, 0.1, deviates);

  const auto fit = fit_ellipse(points, {.withhold = true});

  ASSERT_TRUE(fit.has_value());
  EXPECT_GT(fit->withheld_rms_px, 0.06);
  EXPECT_LT(fit->withheld_rms_px, 0.14);
}

TEST(FitEllipse, RefusesWhatDeterminesNone) {
  tests::Deviates deviates(5);
  std::vector<PlanePoint> few = points_of(5, 2 * kPi, 0.0, deviates);
  std::vector<PlanePoint> line = points_of(20, 2 * kPi, 0.0, deviates);
  for (PlanePoint& p : line) {
    p.y = 2.0 * p.x;
  }

  for (const EllipseMethod method : kMethods) {
    const auto from_few = fit_ellipse(few, {.method = method});
    const auto from_line = fit_ellipse(line, {.method = method});

    ASSERT_FALSE(from_few.has_value());
    EXPECT_EQ(from_few.error(), Error::kBufferTooSmall);
    ASSERT_FALSE(from_line.has_value()) << static_cast<int>(method);
    EXPECT_EQ(from_line.error(), Error::kIllConditioned);
  }
}

}  // namespace
}  // namespace tubesight::core::pose
