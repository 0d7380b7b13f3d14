#include "core/calibration/dense_normal.h"

#include <algorithm>
#include <cmath>

#include "core/base/assert.h"

namespace tubesight::core::calibration {

void DenseNormal::reset(std::int32_t count) {
  TUBESIGHT_ASSERT(count > 0 && count <= kMaxUnknowns);
  count_ = count;
  for (std::int32_t row = 0; row < count; ++row) {
    std::fill_n(&at(row, 0), count, 0.0);
  }
  right_.fill(0.0);
}

void DenseNormal::add(const std::int32_t* where, const double* values, std::int32_t count,
                      double residual) {
  for (std::int32_t i = 0; i < count; ++i) {
    right_[static_cast<std::size_t>(where[i])] += values[i] * residual;
    for (std::int32_t k = 0; k <= i; ++k) {
      // The lower triangle alone.
      at(std::max(where[i], where[k]), std::min(where[i], where[k])) += values[i] * values[k];
    }
  }
}

bool DenseNormal::factor(double damping) {
  constexpr double kTolerance = 1e-14;
  for (std::int32_t j = 0; j < count_; ++j) {
    for (std::int32_t i = j; i < count_; ++i) {
      double sum = at(i, j) * (i == j ? 1.0 + damping : 1.0);
      for (std::int32_t k = 0; k < j; ++k) {
        sum -= factor_at(i, k) * factor_at(j, k);
      }
      if (i == j) {
        if (!(sum > kTolerance * at(j, j)) || !(at(j, j) > 0.0)) {
          return false;
        }
        sum = std::sqrt(sum);
      } else {
        sum /= factor_at(j, j);
      }
      factor_[static_cast<std::size_t>(i) * kMaxUnknowns + static_cast<std::size_t>(j)] = sum;
    }
  }
  return true;
}

void DenseNormal::substitute(double* values) const {
  for (std::int32_t i = 0; i < count_; ++i) {
    for (std::int32_t k = 0; k < i; ++k) {
      values[i] -= factor_at(i, k) * values[k];
    }
    values[i] /= factor_at(i, i);
  }
  for (std::int32_t i = count_ - 1; i >= 0; --i) {
    for (std::int32_t k = i + 1; k < count_; ++k) {
      values[i] -= factor_at(k, i) * values[k];
    }
    values[i] /= factor_at(i, i);
  }
}

void DenseNormal::solve(double* step) const {
  std::copy_n(right_.begin(), count_, step);
  substitute(step);
}

double DenseNormal::gain(const double* step) const {
  double sum = 0.0;
  for (std::int32_t i = 0; i < count_; ++i) {
    sum += right_[static_cast<std::size_t>(i)] * step[i];
  }
  return sum;
}

void DenseNormal::inverse_column(std::int32_t column, double* values) const {
  std::fill_n(values, count_, 0.0);
  values[column] = 1.0;
  substitute(values);
}

}  // namespace tubesight::core::calibration
