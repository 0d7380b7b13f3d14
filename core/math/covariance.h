#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/math/small_matrix.h"

/// Covariances of six values, as one standard deviation each and their correlations.
namespace tubesight::core::math {

/// One standard deviation of a value; 0 where it is held, or rounding left less than nothing.
[[nodiscard]] inline double sigma_of(const Matrix6d& covariance, int i) {
  return std::sqrt(std::max(0.0, covariance(i, i)));
}

/// The correlation of two values; 0 where one is held, 1 of one with itself.
[[nodiscard]] inline double correlation_of(const Matrix6d& covariance, int i, int k) {
  const double scale = sigma_of(covariance, i) * sigma_of(covariance, k);
  return i == k ? 1.0 : scale > 0.0 ? covariance(i, k) / scale : 0.0;
}

/// C(i, k) = correlation(i, k) sigma_i sigma_k.
[[nodiscard]] inline Matrix6d covariance_of(const std::array<double, 6>& sigma,
                                            const Matrix6d& correlation) {
  Matrix6d covariance;
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 6; ++k) {
      covariance(i, k) = correlation(i, k) * sigma[static_cast<std::size_t>(i)] *
                         sigma[static_cast<std::size_t>(k)];
    }
  }
  return covariance;
}

}  // namespace tubesight::core::math
