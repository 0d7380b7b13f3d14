#include "core/math/small_matrix.h"

#include <gtest/gtest.h>

namespace tubesight::core::math {
namespace {

TEST(CholeskyFactor, SolvesAndInvertsByHand) {
  Eigen::Matrix3d a;  // = L L^T with L = [2 0 0; 1 3 0; -1 2 1]
  a << 4, 2, -2, 2, 10, 5, -2, 5, 6;
  Cholesky<3> cholesky;

  ASSERT_TRUE(cholesky.factor(a));

  EXPECT_TRUE(cholesky.forward({2, 4, 2}).isApprox(Eigen::Vector3d(1, 1, 1)));
  EXPECT_TRUE(cholesky.solve(a * Eigen::Vector3d(3, -7, 2)).isApprox(Eigen::Vector3d(3, -7, 2)));
  EXPECT_TRUE((cholesky.inverse() * a).isApprox(Eigen::Matrix3d::Identity()));
}

TEST(CholeskyFactor, RefusesWhatIsNotPositiveDefinite) {
  Eigen::Matrix2d singular;
  singular << 1, 1, 1, 1;
  Eigen::Matrix2d indefinite;
  indefinite << 1, 2, 2, 1;
  Cholesky<2> cholesky;

  EXPECT_FALSE(cholesky.factor(singular));
  EXPECT_FALSE(cholesky.factor(indefinite));
  EXPECT_FALSE(cholesky.factor(Eigen::Matrix2d::Zero()));
  EXPECT_FALSE(cholesky.factor(Eigen::Matrix2d::Constant(NAN)));
}

TEST(SymmetricEigenvalues, AreThoseOfAMatrixMadeFromThem) {
  // Eigenvectors (1, 1, 0), (1, -1, 1), (1, -1, -2) with eigenvalues 1, -2, 5.
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d(1, 1, 0).normalized();
  axes.col(1) = Eigen::Vector3d(1, -1, 1).normalized();
  axes.col(2) = Eigen::Vector3d(1, -1, -2).normalized();
  const Eigen::Matrix3d a = axes * Eigen::Vector3d(1, -2, 5).asDiagonal() * axes.transpose();

  const SymmetricEigen<3> eigen(a);

  EXPECT_NEAR(std::abs(eigen.vector_of_least().dot(axes.col(1))), 1.0, 1e-14);
  EXPECT_NEAR(std::abs(eigen.vector_of_greatest().dot(axes.col(2))), 1.0, 1e-14);
  EXPECT_NEAR(eigen.values.sum(), 4.0, 1e-13);
  EXPECT_TRUE((eigen.vectors.transpose() * eigen.vectors).isApprox(Eigen::Matrix3d::Identity()));
}

}  // namespace
}  // namespace tubesight::core::math
