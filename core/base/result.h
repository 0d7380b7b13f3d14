#pragma once

#include <type_traits>
#include <utility>

#include "core/base/assert.h"
#include "core/base/error.h"

namespace tubesight::core {

/// Carries an error towards a Result<T>; made by `return Unexpected(Error::kTimeout);`.
class Unexpected {
 public:
  constexpr explicit Unexpected(Error error) : error_(error) {}
  [[nodiscard]] constexpr Error error() const { return error_; }

 private:
  Error error_;
};

/// Holds a value or the error that kept it from being made.
///
/// The spelling is a subset of std::expected, so that it can become an alias later; there is no
/// throwing value(). Reading the value of a failed result (or the error of a good one) is a
/// programmer's mistake and asserts. Trivially copyable for a trivially copyable T.
template <typename T>
class [[nodiscard]] Result {
  static_assert(std::is_default_constructible_v<T>, "a failed result holds a default value");

 public:
  using value_type = T;

  constexpr Result(const T& value) : value_(value) {}
  constexpr Result(T&& value) : value_(std::move(value)) {}
  constexpr Result(Unexpected unexpected) : error_(unexpected.error()), has_value_(false) {}

  [[nodiscard]] constexpr bool has_value() const { return has_value_; }
  constexpr explicit operator bool() const { return has_value_; }

  [[nodiscard]] constexpr const T& operator*() const& {
    TUBESIGHT_ASSERT(has_value_);
    return value_;
  }
  [[nodiscard]] constexpr T& operator*() & {
    TUBESIGHT_ASSERT(has_value_);
    return value_;
  }
  [[nodiscard]] constexpr T&& operator*() && {
    TUBESIGHT_ASSERT(has_value_);
    return std::move(value_);
  }
  [[nodiscard]] constexpr const T* operator->() const {
    TUBESIGHT_ASSERT(has_value_);
    return &value_;
  }
  [[nodiscard]] constexpr T* operator->() {
    TUBESIGHT_ASSERT(has_value_);
    return &value_;
  }
  [[nodiscard]] constexpr Error error() const {
    TUBESIGHT_ASSERT(!has_value_);
    return error_;
  }
  [[nodiscard]] constexpr T value_or(T fallback) const { return has_value_ ? value_ : fallback; }

 private:
  T value_{};
  Error error_{};
  bool has_value_ = true;
};

/// The result of something that yields no value but may fail.
template <>
class [[nodiscard]] Result<void> {
 public:
  using value_type = void;

  constexpr Result() = default;
  constexpr Result(Unexpected unexpected) : error_(unexpected.error()), has_value_(false) {}

  [[nodiscard]] constexpr bool has_value() const { return has_value_; }
  constexpr explicit operator bool() const { return has_value_; }
  [[nodiscard]] constexpr Error error() const {
    TUBESIGHT_ASSERT(!has_value_);
    return error_;
  }

 private:
  Error error_{};
  bool has_value_ = true;
};

}  // namespace tubesight::core

/// Passes the error of a Result<void> on to the caller.
#define TUBESIGHT_TRY(expression)                                                            \
  do {                                                                                       \
    if (const auto tubesight_try_result = (expression); !tubesight_try_result.has_value()) { \
      return ::tubesight::core::Unexpected(tubesight_try_result.error());                    \
    }                                                                                        \
  } while (false)
