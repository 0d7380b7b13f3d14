#include "core/calibration/zone_field.h"

#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace tubesight::core::calibration {
namespace {

/// A smooth error of an arm over the sheet, mm.
Eigen::Vector3d arm_error(const Eigen::Vector2d& at) {
  return {0.6 * std::sin(at.x() / 350.0), 0.5 * std::cos(at.y() / 400.0),
          0.8 * std::sin((at.x() + at.y()) / 500.0)};
}

ZonePoints seen_at_random(int count, double sigma_mm, std::uint32_t seed) {
  std::mt19937 source(seed);
  std::uniform_real_distribution<double> place(-800.0, 800.0);
  std::normal_distribution<double> noise(0.0, sigma_mm);
  ZonePoints points;
  for (int i = 0; i < count; ++i) {
    ZonePoint point;
    point.at_mm << place(source), place(source);
    point.off_mm =
        arm_error(point.at_mm) + Eigen::Vector3d(noise(source), noise(source), noise(source));
    point.sigma_mm = sigma_mm;
    static_cast<void>(points.try_push_back(point));
  }
  return points;
}

TEST(ZoneField, CorrectsBetweenThePlacesSeen) {
  const auto field = std::make_unique<ZoneField>();
  field->choose(seen_at_random(60, 0.03, 1));
  double before2 = 0.0;
  double after2 = 0.0;
  for (double x = -600.0; x <= 600.0; x += 150.0) {
    for (double y = -600.0; y <= 600.0; y += 150.0) {
      const Eigen::Vector3d error = arm_error({x, y});
      before2 += error.squaredNorm();
      after2 += (error - field->at({x, y}).off_mm).squaredNorm();
    }
  }
  EXPECT_LT(std::sqrt(after2 / before2), 0.15);
}

TEST(ZoneField, PromisesTheErrorThatItHas) {
  const auto field = std::make_unique<ZoneField>();
  double nees = 0.0;
  int count = 0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    field->choose(seen_at_random(40, 0.05, seed));
    for (double x = -600.0; x <= 600.0; x += 300.0) {
      for (double y = -600.0; y <= 600.0; y += 300.0) {
        const ZoneCorrection here = field->at({x, y});
        const Eigen::Vector3d miss = arm_error({x, y}) - here.off_mm;
        nees += miss.head<2>().squaredNorm() / (2.0 * here.across_mm * here.across_mm);
        ++count;
      }
    }
  }
  EXPECT_GT(nees / count, 0.2) << "not much worse than promised, nor much better";
  EXPECT_LT(nees / count, 2.0);
}

TEST(ZoneField, KnowsNothingFarAway) {
  const auto field = std::make_unique<ZoneField>();
  field->choose(seen_at_random(20, 0.03, 3));
  const ZoneCorrection far = field->at({20000.0, 0.0});
  EXPECT_LT(far.off_mm.norm(), 1e-2);
  EXPECT_NEAR(far.across_mm, field->across_mm(), 1e-2);
  EXPECT_LT(field->at({0.0, 0.0}).across_mm, 0.7 * field->across_mm());
}

TEST(ZoneField, ChoosesALengthLikeThatOfTheErrors) {
  const auto smooth = std::make_unique<ZoneField>();
  smooth->choose(seen_at_random(60, 0.03, 5));
  EXPECT_GE(smooth->length_mm(), 300.0);
  EXPECT_NE(smooth->shape(), ZoneShape::kExponential);
  ZonePoints rough = seen_at_random(60, 0.03, 5);
  std::mt19937 source(6);
  std::normal_distribution<double> noise(0.0, 0.5);
  for (ZonePoint& point : rough) {
    point.off_mm = {noise(source), noise(source), noise(source)};
  }
  const auto field = std::make_unique<ZoneField>();
  field->choose(rough);
  EXPECT_LE(field->length_mm(), 150.0);
}

TEST(ZoneField, FindsThePointThatContradictsTheOthers) {
  ZonePoints points = seen_at_random(40, 0.05, 7);
  points[0].at_mm.setZero();
  points[0].off_mm = arm_error({0.0, 0.0});
  const auto field = std::make_unique<ZoneField>();
  field->choose(points);
  EXPECT_LT(field->contradiction(0), kZoneContradiction);
  ZonePoint wrong = points[0];
  wrong.off_mm.x() += 3.0;
  EXPECT_GT(field->contradiction(wrong), kZoneContradiction);
  EXPECT_LT(field->contradiction(points[0]), kZoneContradiction);
  points[0] = wrong;
  field->choose(points);
  double most = 0.0;
  for (std::int32_t i = 1; i < points.size(); ++i) {
    most = std::max(most, field->contradiction(i));
  }
  EXPECT_GT(field->contradiction(0), kZoneContradiction);
  EXPECT_GT(field->contradiction(0), most);
}

TEST(ZoneField, TakesASinglePoint) {
  ZonePoints points;
  ZonePoint point;
  point.at_mm << 100.0, 0.0;
  point.off_mm << 0.4, 0.0, -0.2;
  point.sigma_mm = 0.05;
  ASSERT_TRUE(points.try_push_back(point));
  const auto field = std::make_unique<ZoneField>();

  field->choose(points);

  EXPECT_NEAR(field->at({100.0, 0.0}).off_mm.x(), 0.4, 0.1);
  EXPECT_LT(field->at({100.0, 0.0}).across_mm, 0.06);
  EXPECT_LT(field->at({3000.0, 0.0}).off_mm.norm(), 0.1);
}

}  // namespace
}  // namespace tubesight::core::calibration
