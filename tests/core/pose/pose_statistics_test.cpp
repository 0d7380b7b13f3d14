#include <array>
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/core/pose/pose_test_support.h"

namespace tubesight::core::pose {
namespace {

constexpr int kPoses = 150;

// Normalised squared errors over many poses: mean of all six and of each component alone.
struct Consistency {
  double mean = 0.0;
  std::array<double, 6> component{};
  std::array<int, 3> below{};  // poses below kQuantiles
  int poses = 0;
};

// Of the chi-square distribution with six degrees of freedom: 10 %, 50 % and 90 % lie below.
constexpr std::array<double, 3> kQuantiles = {2.204, 5.348, 10.645};

Consistency consistency_of(const tests::RimLook& look, const RimBundleOptions& rims,
                           std::size_t tubes) {
  PoseScene scene;
  PoseOptions options;
  options.rims = rims;
  Consistency result;
  for (int i = 0; i < kPoses; ++i) {
    tests::Deviates deviates(static_cast<std::uint64_t>(1000 + i));
    const tests::ToolPlace place{762.0 + 3.0 * deviates.normal(),  457.2 + 3.0 * deviates.normal(),
                                 10.0 + 80.0 * deviates.uniform(), 360.0 * deviates.uniform(),
                                 0.6 * deviates.normal(),          0.6 * deviates.normal()};
    scene.see(place, tubes, look, static_cast<std::uint64_t>(i));
    const PoseOutcome outcome = scene.estimate(options);
    if (!outcome.has_value()) {
      continue;
    }
    const math::Vector6d error = pose_error(outcome.estimate.T_sheet_tool, true_pose(place));
    const math::Matrix6d& covariance = outcome.estimate.covariance;
    const double square = error.dot(covariance.inverse() * error);
    result.mean += square;
    for (std::size_t k = 0; k < kQuantiles.size(); ++k) {
      result.below[k] += square < kQuantiles[k] ? 1 : 0;
    }
    for (int k = 0; k < 6; ++k) {
      result.component[static_cast<std::size_t>(k)] += error(k) * error(k) / covariance(k, k);
    }
    ++result.poses;
  }
  result.mean /= result.poses;
  for (double& component : result.component) {
    component /= result.poses;
  }
  return result;
}

TEST(PoseCovariance, IsTrueWhereNoiseAndSpreadAreKnown) {
  // Noise and spreads as the options say: the sum of six squares is distributed as chi-square with
  // six degrees of freedom, of mean 6 and deviation sqrt(12 / n).
  RimBundleOptions options;
  options.center_sigma_mm = 0.02;
  options.center_sigma_fixed = true;
  options.point_sigma_fixed = true;
  options.radius_sigma_mm = 0.05;
  const Consistency c =
      consistency_of({.noise_px = 0.1, .bore_sigma_mm = 0.1, .center_sigma_mm = 0.02}, options, 16);

  ASSERT_GE(c.poses, kPoses - 3);
  EXPECT_NEAR(c.mean, 6.0, 4.0 * std::sqrt(12.0 / c.poses));
  for (const double component : c.component) {
    EXPECT_NEAR(component, 1.0, 4.0 * std::sqrt(2.0 / c.poses));
  }
  constexpr std::array<double, 3> kShares = {0.1, 0.5, 0.9};
  for (std::size_t k = 0; k < kShares.size(); ++k) {
    const double share = static_cast<double>(c.below[k]) / c.poses;
    EXPECT_NEAR(share, kShares[k], 4.0 * std::sqrt(kShares[k] * (1.0 - kShares[k]) / c.poses)) << k;
  }
}

TEST(PoseCovariance, IsTrueWhereNoiseAndSpreadAreFoundFromThePicture) {
  // Told nothing of a pitch error five times its guess and of noise twice the points' sigma.
  const Consistency c =
      consistency_of({.noise_px = 0.2, .bore_sigma_mm = 0.06, .center_sigma_mm = 0.05}, {}, 25);

  ASSERT_GE(c.poses, kPoses - 3);
  EXPECT_GT(c.mean, 5.0);
  EXPECT_LT(c.mean, 8.0);
}

TEST(PoseCovariance, IsOnTheSafeSideWhereCentresAreExact) {
  const Consistency c = consistency_of({.noise_px = 0.1, .bore_sigma_mm = 0.06}, {}, 9);

  ASSERT_GE(c.poses, kPoses - 3);
  EXPECT_GT(c.mean, 2.0);
  EXPECT_LT(c.mean, 6.5);
}

}  // namespace
}  // namespace tubesight::core::pose
