#include "board/bench/pose/calibration_quality.h"

#include <Eigen/Core>

#include "core/math/covariance.h"

namespace tubesight::board {
namespace {

/// Its rows follow one another in a quality table.
core::math::Matrix6d correlation_of(const drivers::CalibrationQuality& quality) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(quality.correlation.data());
}

}  // namespace

core::math::Matrix6d covariance_of(const drivers::CalibrationQuality& quality) {
  return quality.has_sigma ? core::math::covariance_of(quality.sigma, correlation_of(quality))
                           : core::math::Matrix6d(core::math::Matrix6d::Zero());
}

core::pose::CalibrationUncertainty uncertainty_of(const drivers::SessionFile& file) {
  core::pose::CalibrationUncertainty uncertainty;
  uncertainty.camera_sigma = file.camera_quality.sigma;
  uncertainty.camera_correlation = correlation_of(file.camera_quality);
  uncertainty.tool_sigma = file.tool_quality.sigma;
  uncertainty.tool_correlation = correlation_of(file.tool_quality);
  uncertainty.focal_length_correlation = file.tool_quality.focal_length_correlation;
  return uncertainty;
}

}  // namespace tubesight::board
