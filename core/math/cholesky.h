#pragma once

#include <cmath>

#include <Eigen/Core>

namespace tubesight::core::math {

/// The factor of a small symmetric positive definite matrix, without Eigen's blocked solvers, which
/// refer to malloc from eight rows on.
template <int N>
class Cholesky {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  /// Factors `a`, whose lower triangle counts. False when a pivot falls below `tolerance` times the
  /// diagonal element it came from: not positive definite, or the unknowns can't be told apart.
  [[nodiscard]] bool factor(const Matrix& a, double tolerance = 1e-13) {
    for (int j = 0; j < N; ++j) {
      double pivot = a(j, j);
      for (int k = 0; k < j; ++k) {
        pivot -= factor_(j, k) * factor_(j, k);
      }
      if (!(pivot > tolerance * a(j, j)) || !(a(j, j) > 0.0)) {
        return false;
      }
      factor_(j, j) = std::sqrt(pivot);
      for (int i = j + 1; i < N; ++i) {
        double sum = a(i, j);
        for (int k = 0; k < j; ++k) {
          sum -= factor_(i, k) * factor_(j, k);
        }
        factor_(i, j) = sum / factor_(j, j);
      }
    }
    return true;
  }

  /// L^-1 b.
  [[nodiscard]] Vector forward(Vector b) const {
    for (int i = 0; i < N; ++i) {
      for (int k = 0; k < i; ++k) {
        b(i) -= factor_(i, k) * b(k);
      }
      b(i) /= factor_(i, i);
    }
    return b;
  }
  /// L^-T b.
  [[nodiscard]] Vector backward(Vector b) const {
    for (int i = N - 1; i >= 0; --i) {
      for (int k = i + 1; k < N; ++k) {
        b(i) -= factor_(k, i) * b(k);
      }
      b(i) /= factor_(i, i);
    }
    return b;
  }
  /// A^-1 b.
  [[nodiscard]] Vector solve(const Vector& b) const { return backward(forward(b)); }
  /// A^-1.
  [[nodiscard]] Matrix inverse() const {
    Matrix result;
    for (int column = 0; column < N; ++column) {
      result.col(column) = solve(Vector::Unit(column));
    }
    return result;
  }

 private:
  Matrix factor_ = Matrix::Zero();
};

}  // namespace tubesight::core::math
