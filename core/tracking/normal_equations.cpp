#include "core/tracking/normal_equations.h"

#include <bit>

#include "core/base/instantiate.h"

namespace tubesight::core::tracking {
namespace {

// Half the binary exponent of a positive sum, rounded up: sum * 4^-result is in [1/4, 1).
template <typename Sum>
int half_exponent(Sum sum) {
  if constexpr (std::floating_point<Sum>) {
    return 0;  // floating point needs no scaling
  } else {
    const int bits = 64 - std::countl_zero(static_cast<std::uint64_t>(sum.raw()));
    const int exponent = bits - Sum::kFractionBits;
    return exponent >= 0 ? (exponent + 1) / 2 : -(-exponent / 2);
  }
}

// sum * 2^-exponent.
template <typename To, typename Sum>
To scaled_down(Sum sum, int exponent) {
  if constexpr (std::floating_point<Sum>) {
    return sum;
  } else {
    return To::from_wide_raw(
        shift_right_rounded(sum.raw(), Sum::kFractionBits - To::kFractionBits + exponent));
  }
}

template <typename M>
M shifted(M value, int exponent) {
  if constexpr (std::floating_point<M>) {
    return value;
  } else {
    return M::from_wide_raw(shift_right_rounded(std::int64_t{value.raw()}, exponent));
  }
}

template <typename Sum>
Sum magnitude(Sum a) {
  return a < Sum{} ? -a : a;
}

}  // namespace

template <Scalar S>
void NormalEquations<S>::clear() {
  matrix_ = {};
  value_ = {};
}

// A += w j j^T, b += w j r, of which A's lower triangle is kept.
template <Scalar S>
void NormalEquations<S>::add(const PoseVector<S>& row, Mm<S> value, Mm<S> weight) {
  for (int i = 0; i < kPoseUnknowns; ++i) {
    const auto r = static_cast<std::size_t>(i);
    const Mm<S> weighted = times(row[r], weight);
    for (int j = 0; j <= i; ++j) {
      matrix_[at(i, j)] += product(weighted, row[static_cast<std::size_t>(j)]);
    }
    value_[r] += product(weighted, value);
  }
}

template <Scalar S>
void NormalEquations<S>::add(int unknown, Mm<S> value, Mm<S> weight) {
  matrix_[at(unknown, unknown)] += product(weight, Mm<S>(1));
  value_[static_cast<std::size_t>(unknown)] += product(weight, value);
}

// A += J^T W J, b += J^T W r with J = [j_u; j_v], W = [uu uv; uv vv], r = (u, v): first W J, then
// its product with J^T.
template <Scalar S>
void NormalEquations<S>::add(const Pair& pair) {
  using M = Mm<S>;
  for (int i = 0; i < kPoseUnknowns; ++i) {
    const auto r = static_cast<std::size_t>(i);
    const M weighted_u =
        narrow<M>(product(pair.row_u[r], pair.uu) + product(pair.row_v[r], pair.uv));
    const M weighted_v =
        narrow<M>(product(pair.row_u[r], pair.uv) + product(pair.row_v[r], pair.vv));
    for (int j = 0; j <= i; ++j) {
      const auto c = static_cast<std::size_t>(j);
      matrix_[at(i, j)] += product(weighted_u, pair.row_u[c]) + product(weighted_v, pair.row_v[c]);
    }
    value_[r] += product(weighted_u, pair.u) + product(weighted_v, pair.v);
  }
}

// D A D = L L^T, D = diag(2^-exponent), column by column:
//
//   L_ij = ((D A D)_ij - sum over k < j of L_ik L_jk) / L_jj,   L_ii = sqrt of the same with j = i.
template <Scalar S>
bool NormalEquations<S>::factor() {
  using U = Unit<S>;
  for (int i = 0; i < kPoseUnknowns; ++i) {
    if (!(Sum{} < matrix_[at(i, i)])) {
      return false;
    }
    exponent_[static_cast<std::size_t>(i)] = half_exponent(matrix_[at(i, i)]);
  }
  for (int i = 0; i < kPoseUnknowns; ++i) {
    for (int j = 0; j <= i; ++j) {
      const int exponent =
          exponent_[static_cast<std::size_t>(i)] + exponent_[static_cast<std::size_t>(j)];
      auto rest = widen<60>(scaled_down<U>(matrix_[at(i, j)], exponent));
      for (int k = 0; k < j; ++k) {
        rest -= product(factor_[at(i, k)], factor_[at(j, k)]);
      }
      const U remainder = narrow<U>(rest);
      if (i == j) {
        // A pivot of 2^-22 of the diagonal: the unknown is not determined by the others.
        if (!(from_scaled<U>(1, 22) < remainder)) {
          return false;
        }
        factor_[at(i, i)] = square_root(remainder);
      } else {
        factor_[at(i, j)] = quotient<U>(remainder, factor_[at(j, j)]);
      }
    }
  }
  return true;
}

// L y = value: y_i = (value_i - sum over k < i of L_ik y_k) / L_ii.
template <Scalar S>
PoseVector<S> NormalEquations<S>::forward(const PoseVector<S>& value) const {
  PoseVector<S> y = value;
  for (int i = 0; i < kPoseUnknowns; ++i) {
    const auto r = static_cast<std::size_t>(i);
    auto rest = widen<50>(y[r]);
    for (int k = 0; k < i; ++k) {
      rest -= product(factor_[at(i, k)], y[static_cast<std::size_t>(k)]);
    }
    y[r] = quotient<Mm<S>>(narrow<Mm<S>>(rest), factor_[at(i, i)]);
  }
  return y;
}

// A x = b as L y = D b, L^T z = y, x = D z; b and x are scaled by 2^-block and back.
template <Scalar S>
PoseVector<S> NormalEquations<S>::solve() const {
  using M = Mm<S>;
  // One exponent for the block of right-hand sides: the largest becomes at most 1/2, which leaves
  // 2^12 for the growth that the smallest pivot allows.
  int block = 0;
  if constexpr (!std::floating_point<M>) {
    Sum largest{};
    for (std::size_t i = 0; i < kPoseUnknowns; ++i) {
      const Sum scaled = Sum::from_raw(
          shift_right_rounded(magnitude(value_[i]).raw(), exponent_[i] > 0 ? exponent_[i] : 0));
      largest = largest < scaled ? scaled : largest;
    }
    const int bits = 64 - std::countl_zero(static_cast<std::uint64_t>(largest.raw()));
    block = bits - Sum::kFractionBits + 1;
  }
  PoseVector<S> x;
  for (std::size_t i = 0; i < kPoseUnknowns; ++i) {
    x[i] = scaled_down<M>(value_[i], exponent_[i] + block);
  }
  x = forward(x);
  for (int i = kPoseUnknowns - 1; i >= 0; --i) {
    const auto r = static_cast<std::size_t>(i);
    auto rest = widen<50>(x[r]);
    for (int k = i + 1; k < kPoseUnknowns; ++k) {
      rest -= product(factor_[at(k, i)], x[static_cast<std::size_t>(k)]);
    }
    x[r] = quotient<M>(narrow<M>(rest), factor_[at(i, i)]);
  }
  for (std::size_t i = 0; i < kPoseUnknowns; ++i) {
    x[i] = shifted(x[i], exponent_[i] - block);
  }
  return x;
}

// sqrt(j^T A^-1 j) = |L^-1 D j|.
template <Scalar S>
Mm<S> NormalEquations<S>::deviation(const PoseVector<S>& row) const {
  PoseVector<S> scaled;
  for (std::size_t i = 0; i < kPoseUnknowns; ++i) {
    scaled[i] = shifted(row[i], exponent_[i]);
  }
  const PoseVector<S> y = forward(scaled);
  Sum sum{};
  for (const Mm<S>& element : y) {
    sum += product(element, element);
  }
  return root<Mm<S>>(sum);
}

TUBESIGHT_INSTANTIATE_CLASS(NormalEquations)

}  // namespace tubesight::core::tracking
