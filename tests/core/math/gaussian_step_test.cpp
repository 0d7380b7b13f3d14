#include "core/math/gaussian_step.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace tubesight::core::math {
namespace {

TEST(GaussianStepAt, IsWhatLibmSays) {
  for (double x = -7.0; x <= 7.0; x += 0.00173) {
    const GaussianStep step = gaussian_step(x);

    ASSERT_NEAR(step.share, 0.5 * std::erfc(-x / std::numbers::sqrt2), 1e-8) << x;
    ASSERT_NEAR(step.slope, std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi), 2e-6) << x;
  }
}

TEST(GaussianStepAt, IsTheTablesOwnAtItsNodes) {
  // From a printed table of the normal distribution.
  EXPECT_DOUBLE_EQ(gaussian_step(0.0).share, 0.5);
  EXPECT_NEAR(gaussian_step(1.0).share, 0.8413447461, 1e-10);
  EXPECT_NEAR(gaussian_step(-2.0).share, 0.0227501319, 1e-10);
  EXPECT_NEAR(gaussian_step(0.0).slope, 0.3989422804, 1e-10);
}

TEST(GaussianStepAt, EndsAtNothingAndAll) {
  EXPECT_EQ(gaussian_step(-1e9).share, 0.0);
  EXPECT_EQ(gaussian_step(1e9).share, 1.0);
  EXPECT_EQ(gaussian_step(1e9).slope, 0.0);
  EXPECT_EQ(gaussian_step(NAN).slope, 0.0);
}

}  // namespace
}  // namespace tubesight::core::math
