#include "core/math/rotation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/transform.h"

namespace tubesight::core::math {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

TEST(ExpRotation, TurnsByTheRightHandRule) {
  const Eigen::Matrix3d R = exp_rotation({0.0, 0.0, 90.0 * kDegree});

  EXPECT_TRUE((R * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-15));
}

TEST(ExpRotation, IsUndoneByLog) {
  for (const double size : {1e-9, 0.99e-4, 1.01e-4, 0.1, 2.0, 3.1}) {
    const Eigen::Vector3d theta = size * Eigen::Vector3d(0.6, -0.48, 0.64);

    const Eigen::Vector3d back = log_rotation(exp_rotation(theta));

    EXPECT_LT((back - theta).norm(), 1e-12 * (1.0 + size)) << size;
  }
}

TEST(ExpRotation, StaysARotationWhereTheSeriesEnds) {
  const Eigen::Matrix3d R = exp_rotation(Eigen::Vector3d(0.6, -0.48, 0.64) * 0.9999e-4);

  EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-13);
}

TEST(AnglesOf, AreThoseThatTheRotationWasMadeFrom) {
  for (const std::array<double, 3> degrees :
       {std::array<double, 3>{30.0, -20.0, 10.0}, std::array<double, 3>{-170.0, 80.0, 179.0},
        std::array<double, 3>{-0.0639, -0.8174, 47.9947}}) {
    const auto angles = angles_of(rotation_from_degrees(degrees));

    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(angles[i], degrees[i] * kDegree, 1e-13);
    }
  }
}

TEST(AnglesOf, PutsAllOfAGimbalLockedTurnIntoAlpha) {
  const auto angles = angles_of(rotation_from_degrees({40.0, 90.0, 15.0}));

  EXPECT_NEAR(angles[0], 25.0 * kDegree, 1e-9);
  EXPECT_NEAR(angles[1], 90.0 * kDegree, 1e-7);
  EXPECT_EQ(angles[2], 0.0);
}

TEST(Orthonormal, MendsAColumnThatDriftedOff) {
  Eigen::Matrix3d drifted = rotation_from_degrees({10.0, 20.0, 30.0});
  drifted(1, 1) += 1e-6;

  const Eigen::Matrix3d R = orthonormal(drifted);

  EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_LT((R - drifted).norm(), 2e-6);
}

}  // namespace
}  // namespace tubesight::core::math
