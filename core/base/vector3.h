#pragma once

#include <array>

#include "core/base/scalar.h"

namespace tubesight::core {

/// Three numbers; small enough that fixed point and floating point share it.
template <typename T>
struct Vector3 {
  T x{};
  T y{};
  T z{};

  friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr bool operator==(const Vector3&, const Vector3&) = default;
};

/// The scalar product, not yet narrowed.
template <typename A, typename B>
[[nodiscard]] constexpr auto dot(const Vector3<A>& a, const Vector3<B>& b) {
  return product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z);
}

/// The vector product rounded into T.
template <typename T, typename A, typename B>
[[nodiscard]] constexpr Vector3<T> cross(const Vector3<A>& a, const Vector3<B>& b) {
  return {narrow<T>(product(a.y, b.z) - product(a.z, b.y)),
          narrow<T>(product(a.z, b.x) - product(a.x, b.z)),
          narrow<T>(product(a.x, b.y) - product(a.y, b.x))};
}

/// Two numbers: a point of a picture or of a plane.
template <typename T>
struct Vector2 {
  T x{};
  T y{};

  friend constexpr Vector2 operator+(const Vector2& a, const Vector2& b) {
    return {a.x + b.x, a.y + b.y};
  }
  friend constexpr Vector2 operator-(const Vector2& a, const Vector2& b) {
    return {a.x - b.x, a.y - b.y};
  }
  friend constexpr bool operator==(const Vector2&, const Vector2&) = default;
};

}  // namespace tubesight::core
