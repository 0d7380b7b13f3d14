#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>

#include "core/base/fixed.h"

namespace tubesight::core {

/// Names the fixed-point instance of a template over Scalar: the default of the tracking path.
struct FixedPoint {};

/// The kinds of arithmetic that the tracking path is instantiated for.
template <typename S>
concept Scalar = std::same_as<S, FixedPoint> || std::same_as<S, float> || std::same_as<S, double>;

/// The number types of one kind of arithmetic.
///
/// With floating point all are the same; in fixed point each has the range its quantity needs:
template <Scalar S>
struct Numbers {
  using Px = S;
  using Mm = S;
  using Unit = S;
  using Ratio = S;
};

template <>
struct Numbers<FixedPoint> {
  using Px = Fixed<16, 16>;    ///< pixels: ±32768 in steps of 1.5e-5
  using Mm = Fixed<12, 20>;    ///< millimetres of the scene, derivatives: ±2048, steps of 1e-6
  using Unit = Fixed<2, 30>;   ///< elements of rotations: ±2, steps of 1e-9
  using Ratio = Fixed<3, 29>;  ///< the image plane at unit distance: ±4, steps of 2e-9
};

template <Scalar S>
using Px = typename Numbers<S>::Px;
template <Scalar S>
using Mm = typename Numbers<S>::Mm;
template <Scalar S>
using Unit = typename Numbers<S>::Unit;
template <Scalar S>
using Ratio = typename Numbers<S>::Ratio;

// The operations of fixed.h for floating point, so that one template body serves all kinds.

template <std::floating_point T>
[[nodiscard]] constexpr T product(T a, T b) {
  return a * b;
}
template <int F, std::floating_point T>
[[nodiscard]] constexpr T widen(T a) {
  return a;
}
template <std::floating_point T>
[[nodiscard]] constexpr T narrow(T wide) {
  return wide;
}
template <std::floating_point T>
[[nodiscard]] constexpr T convert(T a) {
  return a;
}
template <std::floating_point T>
[[nodiscard]] constexpr T quotient(T a, T b) {
  return a / b;
}
template <std::floating_point T>
[[nodiscard]] T square_root(T a) {
  return a > T(0) ? std::sqrt(a) : T(0);
}

template <std::floating_point T>
[[nodiscard]] T root(T sum) {
  return square_root(sum);
}

/// A number of type T from an integer of 1/2^bits steps.
template <typename T>
[[nodiscard]] constexpr T from_scaled(std::int64_t value, int bits) {
  if constexpr (std::floating_point<T>) {
    return static_cast<T>(value) / static_cast<T>(std::int64_t{1} << bits);
  } else {
    return T::from_wide_raw(shift_right_rounded(value, bits - T::kFractionBits));
  }
}

/// A number in steps of 1/2^bits, rounded to nearest, ties away from zero, within 32 bits.
template <typename T>
[[nodiscard]] constexpr std::int32_t to_scaled(T value, int bits) {
  if constexpr (std::floating_point<T>) {
    const double scaled = static_cast<double>(value) * static_cast<double>(std::int64_t{1} << bits);
    const double limit = 2147483647.0;
    // NaN is taken as too large, as in Fixed.
    const double bounded = !(scaled < limit) ? limit : (scaled < -limit ? -limit : scaled);
    return static_cast<std::int32_t>(bounded + (bounded < 0.0 ? -0.5 : 0.5));
  } else {
    return Fixed<16, 16>::from_wide_raw(
               shift_right_rounded(std::int64_t{value.raw()}, T::kFractionBits - bits))
        .raw();
  }
}

/// The nearest whole number, ties away from zero.
template <typename T>
[[nodiscard]] constexpr std::int32_t rounded(T value) {
  return to_scaled(value, 0);
}

template <typename T>
[[nodiscard]] constexpr T absolute(T a) {
  return a < T{} ? -a : a;
}

/// a * b rounded into a's type.
template <typename A, typename B>
[[nodiscard]] constexpr A times(A a, B b) {
  return narrow<A>(product(a, b));
}

}  // namespace tubesight::core
