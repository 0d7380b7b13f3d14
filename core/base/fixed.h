#pragma once

#include <bit>
#include <compare>
#include <concepts>
#include <cstdint>
#include <limits>

#include "core/base/overflow.h"

namespace tubesight::core {

/// A 64-bit intermediate with FractionBits fraction bits: sums of products before narrowing.
///
/// Range ±2^(63 - FractionBits). Adding never rounds; the user's bound on the terms shows that the
/// sum fits.
template <int FractionBits>
class Wide {
 public:
  static constexpr int kFractionBits = FractionBits;

  constexpr Wide() = default;
  [[nodiscard]] static constexpr Wide from_raw(std::int64_t raw) {
    Wide wide;
    wide.raw_ = raw;
    return wide;
  }
  [[nodiscard]] constexpr std::int64_t raw() const { return raw_; }

  constexpr Wide& operator+=(Wide other) {
    raw_ += other.raw_;
    return *this;
  }
  constexpr Wide& operator-=(Wide other) {
    raw_ -= other.raw_;
    return *this;
  }
  friend constexpr Wide operator+(Wide a, Wide b) { return from_raw(a.raw_ + b.raw_); }
  friend constexpr Wide operator-(Wide a, Wide b) { return from_raw(a.raw_ - b.raw_); }
  friend constexpr Wide operator-(Wide a) { return from_raw(-a.raw_); }
  friend constexpr auto operator<=>(Wide, Wide) = default;

 private:
  std::int64_t raw_ = 0;
};

/// Shifts right by `bits`, rounding to nearest, ties away from zero; a negative count shifts left.
[[nodiscard]] constexpr std::int64_t shift_right_rounded(std::int64_t value, int bits) {
  if (bits <= 0) {
    return value << -bits;
  }
  const std::int64_t half = std::int64_t{1} << (bits - 1);
  // For negatives the tie must go down: one less than half is added before the flooring shift.
  return (value + half - (value < 0 ? 1 : 0)) >> bits;
}

/// Divides, rounding to nearest, ties away from zero. The divisor is not zero.
[[nodiscard]] constexpr std::int64_t divide_rounded(std::int64_t dividend, std::int64_t divisor) {
  const std::int64_t half = (divisor < 0 ? -divisor : divisor) / 2;
  return (dividend + (dividend < 0 ? -half : half)) / divisor;
}

/// A signed number of 32 bits: IntegerBits (sign included) and FractionBits.
///
/// From -2^(I-1) to just under 2^(I-1) in steps of 2^-F: Fixed<16, 16> millimetres reach from
/// -32768 to just under 32768, step 1/65536. Products are formed in 64 bits and narrowed once,
/// round to nearest, ties away from zero. What does not fit follows the Overflow policy: by default
/// it saturates and raises the sticky flag of overflow.h.
template <int IntegerBits, int FractionBits, typename Overflow = SaturateSticky>
class Fixed {
  static_assert(IntegerBits >= 1 && FractionBits >= 0 && IntegerBits + FractionBits == 32);

 public:
  static constexpr int kFractionBits = FractionBits;

  constexpr Fixed() = default;

  /// The number whose 32 bits are `raw`.
  [[nodiscard]] static constexpr Fixed from_raw(std::int32_t raw) {
    Fixed fixed;
    fixed.raw_ = raw;
    return fixed;
  }
  /// The number nearest to `raw` / 2^F, by the overflow policy when `raw` exceeds 32 bits.
  [[nodiscard]] static constexpr Fixed from_wide_raw(std::int64_t raw) {
    const auto low = static_cast<std::int32_t>(raw);  // modulo 2^32, since C++20
    if (low != raw) [[unlikely]] {
      return from_raw(raw > 0 ? Overflow::too_large() : Overflow::too_small());
    }
    return from_raw(low);
  }
  constexpr explicit Fixed(std::int32_t whole)
      : raw_(from_wide_raw(static_cast<std::int64_t>(whole) * kOne).raw_) {}
  /// Rounds to nearest, ties away from zero; for settings and constants, not for the path. NaN is
  /// taken as too large.
  template <std::floating_point T>
  constexpr explicit Fixed(T value)
      : raw_(from_wide_raw(rounded_raw(static_cast<double>(value))).raw_) {}

  [[nodiscard]] constexpr std::int32_t raw() const { return raw_; }
  template <std::floating_point T>
  constexpr explicit operator T() const {
    return static_cast<T>(static_cast<double>(raw_) / static_cast<double>(kOne));
  }

  // Processors tell that 32 bits overflow; to form the sum in 64 bits and compare costs three times
  // the instructions, and sums are the most frequent of all that tracking does.
  friend constexpr Fixed operator+(Fixed a, Fixed b) {
    std::int32_t sum = 0;
    if (__builtin_add_overflow(a.raw_, b.raw_, &sum)) [[unlikely]] {
      return from_raw(a.raw_ > 0 ? Overflow::too_large() : Overflow::too_small());
    }
    return from_raw(sum);
  }
  friend constexpr Fixed operator-(Fixed a, Fixed b) {
    std::int32_t difference = 0;
    if (__builtin_sub_overflow(a.raw_, b.raw_, &difference)) [[unlikely]] {
      return from_raw(a.raw_ >= 0 ? Overflow::too_large() : Overflow::too_small());
    }
    return from_raw(difference);
  }
  friend constexpr Fixed operator-(Fixed a) { return from_wide_raw(-std::int64_t{a.raw_}); }
  constexpr Fixed& operator+=(Fixed other) { return *this = *this + other; }
  constexpr Fixed& operator-=(Fixed other) { return *this = *this - other; }
  friend constexpr auto operator<=>(Fixed, Fixed) = default;

 private:
  // Bounded first: what a 64-bit integer cannot hold must not be converted into one.
  static constexpr std::int64_t rounded_raw(double value) {
    constexpr double kBeyond = 4294967296.0;
    const double scaled = value * static_cast<double>(kOne);
    const double bounded = !(scaled < kBeyond) ? kBeyond : (scaled < -kBeyond ? -kBeyond : scaled);
    return static_cast<std::int64_t>(bounded + (bounded < 0.0 ? -0.5 : 0.5));
  }

  static constexpr std::int64_t kOne = std::int64_t{1} << FractionBits;
  std::int32_t raw_ = 0;
};

/// The exact product, to be summed with others before it is narrowed.
template <int I1, int F1, int I2, int F2, typename O>
[[nodiscard]] constexpr Wide<F1 + F2> product(Fixed<I1, F1, O> a, Fixed<I2, F2, O> b) {
  return Wide<F1 + F2>::from_raw(std::int64_t{a.raw()} * b.raw());
}

/// The number as an intermediate with F fraction bits, exact.
template <int F, int I1, int F1, typename O>
[[nodiscard]] constexpr Wide<F> widen(Fixed<I1, F1, O> a) {
  static_assert(F >= F1, "widening never drops bits");
  return Wide<F>::from_raw(std::int64_t{a.raw()} << (F - F1));
}

/// An intermediate rounded into a 32-bit number.
template <typename T, int F>
[[nodiscard]] constexpr T narrow(Wide<F> wide) {
  return T::from_wide_raw(shift_right_rounded(wide.raw(), F - T::kFractionBits));
}

/// A number in another format, rounded where bits are dropped.
template <typename T, int I1, int F1, typename O>
[[nodiscard]] constexpr T convert(Fixed<I1, F1, O> a) {
  return T::from_wide_raw(shift_right_rounded(std::int64_t{a.raw()}, F1 - T::kFractionBits));
}

/// a / b rounded into T; `b` is not zero. What the shifted dividend cannot hold in 64 bits follows
/// the overflow policy.
template <typename T, int I1, int F1, int I2, int F2, typename O>
[[nodiscard]] constexpr T quotient(Fixed<I1, F1, O> a, Fixed<I2, F2, O> b) {
  constexpr int kShift = T::kFractionBits - F1 + F2;
  static_assert(kShift >= 0 && kShift <= 31, "the dividend would lose bits or leave 64");
  return T::from_wide_raw(divide_rounded(std::int64_t{a.raw()} << kShift, b.raw()));
}

/// The largest integer whose square does not exceed `value`: Newton's method in whole numbers,
/// which falls from a power of two above the root to it, by five divisions or six.
[[nodiscard]] constexpr std::uint32_t integer_square_root(std::uint64_t value) {
  if (value == 0) {
    return 0;
  }
  std::uint64_t root = std::uint64_t{1} << ((std::bit_width(value) + 1) / 2);
  while (true) {
    const std::uint64_t next = (root + value / root) / 2;
    if (next >= root) {
      return static_cast<std::uint32_t>(root);
    }
    root = next;
  }
}

/// The square root, rounded down to a step of the format; negative numbers give zero.
template <int I, int F, typename O>
[[nodiscard]] constexpr Fixed<I, F, O> square_root(Fixed<I, F, O> a) {
  if (a.raw() <= 0) {
    return {};
  }
  return Fixed<I, F, O>::from_wide_raw(
      integer_square_root(static_cast<std::uint64_t>(a.raw()) << F));
}

/// The square root of a sum of products into T, rounded down to a step; negative sums give zero.
/// T has half the fraction bits of the sum.
template <typename T, int F>
[[nodiscard]] constexpr T root(Wide<F> sum) {
  static_assert(F == 2 * T::kFractionBits);
  return sum.raw() <= 0
             ? T{}
             : T::from_wide_raw(integer_square_root(static_cast<std::uint64_t>(sum.raw())));
}

}  // namespace tubesight::core
