#include "board/bench/pose/calibration_quality.h"

#include <cstddef>
#include <memory>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

/// Six sigmas, and correlations of which no two are the same, though no calibration's are like
/// that.
drivers::CalibrationQuality numbered(double first) {
  drivers::CalibrationQuality quality;
  quality.has_sigma = true;
  quality.sigma = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  for (std::size_t i = 0; i < quality.correlation.size(); ++i) {
    quality.correlation[i] = first + 0.01 * static_cast<double>(i);
  }
  return quality;
}

TEST(CalibrationQuality, IsReadRowByRow) {
  const core::math::Matrix6d covariance = covariance_of(numbered(0.0));
  EXPECT_DOUBLE_EQ(covariance(0, 1), 0.01 * 1.0 * 2.0);
  EXPECT_DOUBLE_EQ(covariance(1, 0), 0.06 * 2.0 * 1.0);
  EXPECT_DOUBLE_EQ(covariance(5, 4), 0.34 * 6.0 * 5.0);
}

TEST(CalibrationQuality, WithoutSigmasIsExact) {
  drivers::CalibrationQuality quality = numbered(0.0);
  quality.has_sigma = false;
  EXPECT_EQ(covariance_of(quality), core::math::Matrix6d::Zero());
}

TEST(CalibrationQuality, OfCameraAndToolAreNotMixedUp) {
  const auto file = std::make_unique<drivers::SessionFile>();
  file->camera_quality = numbered(0.0);
  file->tool_quality = numbered(0.5);
  file->tool_quality.sigma[3] = 0.25;
  file->tool_quality.focal_length_correlation[2] = -0.75;

  const core::pose::CalibrationUncertainty uncertainty = uncertainty_of(*file);

  EXPECT_EQ(uncertainty.camera_sigma[3], 4.0);
  EXPECT_EQ(uncertainty.tool_sigma[3], 0.25);
  EXPECT_DOUBLE_EQ(uncertainty.camera_correlation(2, 1), 0.13);
  EXPECT_DOUBLE_EQ(uncertainty.tool_correlation(2, 1), 0.63);
  EXPECT_EQ(uncertainty.focal_length_correlation[2], -0.75);
}

}  // namespace
}  // namespace tubesight::board
