#include "core/math/covariance.h"

#include <gtest/gtest.h>

namespace tubesight::core::math {
namespace {

TEST(Covariance, IsThatOfItsSigmasAndCorrelations) {
  Matrix6d correlation = Matrix6d::Identity();
  correlation(0, 2) = correlation(2, 0) = -0.5;
  correlation(1, 4) = correlation(4, 1) = 0.25;

  const Matrix6d covariance = covariance_of({2.0, 4.0, 3.0, 1.0, 0.5, 0.0}, correlation);

  EXPECT_EQ(covariance(0, 0), 4.0);
  EXPECT_EQ(covariance(0, 2), -3.0);
  EXPECT_EQ(covariance(2, 0), -3.0);
  EXPECT_EQ(covariance(1, 4), 0.5);
  EXPECT_EQ(covariance(0, 1), 0.0);
  EXPECT_EQ(sigma_of(covariance, 1), 4.0);
  EXPECT_EQ(correlation_of(covariance, 0, 2), -0.5);
  EXPECT_EQ(correlation_of(covariance, 4, 1), 0.25);
}

TEST(Covariance, OfAValueThatIsHeldHasNoCorrelation) {
  Matrix6d covariance = Matrix6d::Identity();
  covariance(3, 3) = 0.0;
  covariance(5, 5) = -1e-30;
  EXPECT_EQ(correlation_of(covariance, 3, 0), 0.0);
  EXPECT_EQ(correlation_of(covariance, 3, 3), 1.0);
  EXPECT_EQ(sigma_of(covariance, 5), 0.0);
}

}  // namespace
}  // namespace tubesight::core::math
