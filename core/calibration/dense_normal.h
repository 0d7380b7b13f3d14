#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tubesight::core::calibration {

/// Unknowns of the largest fit: a camera with tangential distortion, a template's bow, a stage and
/// 32 free poses.
inline constexpr std::int32_t kMaxUnknowns = 11 + 8 + 6 * 32;

/// Normal equations of a fit whose size is known when it runs, and their factor. 0.7 MB: in a
/// workspace.
class DenseNormal {
 public:
  /// Begins with zero, for `count` unknowns.
  void reset(std::int32_t count);

  /// Adds a row: `values` are derivatives by the unknowns `at`.
  void add(const std::int32_t* at, const double* values, std::int32_t count, double residual);

  /// Factors the matrix with its diagonal grown by `damping` of itself. False: an unknown is not
  /// told by the rows.
  [[nodiscard]] bool factor(double damping);

  /// The step: the factored matrix' solution for the rows' residuals.
  void solve(double* step) const;

  /// By how much the sum of the squared residuals falls with that step: g^T step.
  [[nodiscard]] double gain(const double* step) const;

  /// An element of the factored matrix' inverse, column by column: solves for the unit vector.
  void inverse_column(std::int32_t column, double* values) const;

  [[nodiscard]] std::int32_t count() const { return count_; }

 private:
  [[nodiscard]] double& at(std::int32_t row, std::int32_t column) {
    return matrix_[static_cast<std::size_t>(row) * kMaxUnknowns + static_cast<std::size_t>(column)];
  }
  [[nodiscard]] double factor_at(std::int32_t row, std::int32_t column) const {
    return factor_[static_cast<std::size_t>(row) * kMaxUnknowns + static_cast<std::size_t>(column)];
  }
  void substitute(double* values) const;

  std::int32_t count_ = 0;
  std::array<double, static_cast<std::size_t>(kMaxUnknowns) * kMaxUnknowns> matrix_{};
  std::array<double, static_cast<std::size_t>(kMaxUnknowns) * kMaxUnknowns> factor_{};
  std::array<double, kMaxUnknowns> right_{};
};

}  // namespace tubesight::core::calibration
