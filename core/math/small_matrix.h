#pragma once

#include <cmath>

#include <Eigen/Core>

namespace tubesight::core::math {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

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

/// Eigenvalues and eigenvectors of a small symmetric matrix by Jacobi's rotations [Golub2013
/// sec. 8.5]. Eigen's own solver refers to malloc from five rows on.
template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;  ///< columns, orthonormal; in no order

  explicit SymmetricEigen(Eigen::Matrix<double, N, N> a) {
    vectors.setIdentity();
    // Convergence is quadratic: six sweeps or so.
    for (int sweep = 0; sweep < 30 && sweep_once(a); ++sweep) {
    }
    values = a.diagonal();
  }

  [[nodiscard]] Eigen::Matrix<double, N, 1> vector_of_least() const {
    Eigen::Index index = 0;
    values.minCoeff(&index);
    return vectors.col(index);
  }
  [[nodiscard]] Eigen::Matrix<double, N, 1> vector_of_greatest() const {
    Eigen::Index index = 0;
    values.maxCoeff(&index);
    return vectors.col(index);
  }

 private:
  bool sweep_once(Eigen::Matrix<double, N, N>& a) {
    bool turned = false;
    for (int p = 0; p < N; ++p) {
      for (int q = p + 1; q < N; ++q) {
        if (std::abs(a(p, q)) > 1e-17 * std::sqrt(std::abs(a(p, p) * a(q, q))) &&
            std::abs(a(p, q)) > 1e-300) {
          turn(a, p, q);
          turned = true;
        }
      }
    }
    return turned;
  }

  void turn(Eigen::Matrix<double, N, N>& a, int p, int q) {
    const double tau = (a(q, q) - a(p, p)) / (2.0 * a(p, q));
    const double t = (tau < 0.0 ? -1.0 : 1.0) / (std::abs(tau) + std::sqrt(1.0 + tau * tau));
    const double c = 1.0 / std::sqrt(1.0 + t * t);
    const double s = t * c;
    for (int i = 0; i < N; ++i) {
      const double x = a(i, p);
      a(i, p) = c * x - s * a(i, q);
      a(i, q) = s * x + c * a(i, q);
      const double v = vectors(i, p);
      vectors(i, p) = c * v - s * vectors(i, q);
      vectors(i, q) = s * v + c * vectors(i, q);
    }
    for (int i = 0; i < N; ++i) {
      const double x = a(p, i);
      a(p, i) = c * x - s * a(q, i);
      a(q, i) = s * x + c * a(q, i);
    }
    a(p, q) = 0.0;
    a(q, p) = 0.0;
  }
};

}  // namespace tubesight::core::math
