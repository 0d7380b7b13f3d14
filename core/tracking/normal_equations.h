#pragma once

#include <array>
#include <cstdint>

#include "core/base/scalar.h"

namespace tubesight::core::tracking {

/// Unknowns of the pose fit: three turns in 1/128 rad and three shifts in mm, camera frame.
inline constexpr int kPoseUnknowns = 6;

/// One row or right-hand side for the unknowns.
template <Scalar S>
using PoseVector = std::array<Mm<S>, kPoseUnknowns>;

/// Weighted least squares for six unknowns: sums, Cholesky factor, solution, variances.
///
/// In fixed point the sums are 64 bits wide and each unknown is scaled by a power of two so that
/// the matrix has a diagonal between 1/4 and 1: the factor then fits numbers of 32 bits whatever
/// the geometry. Bounds: rows up to 64 in any element, 200 rows of weight 16.
template <Scalar S>
class NormalEquations {
 public:
  void clear();

  /// Adds weight * (row^T row) and weight * row * value.
  void add(const PoseVector<S>& row, Mm<S> value, Mm<S> weight);

  /// The same for a row that is 1 for one unknown and 0 for the others: a sixth of the cost.
  void add(int unknown, Mm<S> value, Mm<S> weight);

  /// A pair of rows whose values have the information matrix [uu uv; uv vv].
  struct Pair {
    PoseVector<S> row_u{};
    PoseVector<S> row_v{};
    Mm<S> u{};
    Mm<S> v{};
    Mm<S> uu{};
    Mm<S> uv{};
    Mm<S> vv{};
  };
  void add(const Pair& pair);

  /// Factors the matrix. False when it is singular to working accuracy.
  [[nodiscard]] bool factor();

  /// The solution; after factor().
  [[nodiscard]] PoseVector<S> solve() const;

  /// The standard deviation of row * unknowns where one unit of weight has standard deviation 1;
  /// after factor(). Elements of `row` up to 64.
  [[nodiscard]] Mm<S> deviation(const PoseVector<S>& row) const;

 private:
  static constexpr int kElements = kPoseUnknowns * (kPoseUnknowns + 1) / 2;
  using Sum = decltype(product(Mm<S>{}, Mm<S>{}));

  [[nodiscard]] static constexpr std::size_t at(int row, int column) {
    return static_cast<std::size_t>(row * (row + 1) / 2 + column);
  }
  [[nodiscard]] PoseVector<S> forward(const PoseVector<S>& value) const;

  std::array<Sum, kElements> matrix_{};  // lower triangle
  std::array<Sum, kPoseUnknowns> value_{};
  std::array<Unit<S>, kElements> factor_{};
  std::array<int, kPoseUnknowns> exponent_{};  // unknown i is scaled by 2^-exponent
};

}  // namespace tubesight::core::tracking
