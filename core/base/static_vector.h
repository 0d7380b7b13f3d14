#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "core/base/assert.h"

namespace tubesight::core {

/// A list of at most Capacity elements held inside the object; nothing is allocated.
///
/// Trivially copyable for a trivially copyable T; other T are held too (Eigen's matrices copy by
/// functions of their own), as long as nothing is to be done at their end: elements beyond the size
/// stay alive. Running full is a documented result: try_push_back says false and the list stays as
/// it was.
template <typename T, std::int32_t Capacity>
class StaticVector {
  static_assert(std::is_trivially_destructible_v<T>);
  static_assert(Capacity > 0);

 public:
  using value_type = T;

  [[nodiscard]] static constexpr std::int32_t capacity() { return Capacity; }
  [[nodiscard]] constexpr std::int32_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr bool full() const { return size_ == Capacity; }

  /// Appends and says true, or says false when the list is full.
  [[nodiscard]] constexpr bool try_push_back(const T& value) {
    if (full()) {
      return false;
    }
    items_[static_cast<std::size_t>(size_)] = value;
    ++size_;
    return true;
  }

  constexpr void clear() { size_ = 0; }

  /// Shortens the list to its first `count` elements.
  constexpr void truncate(std::int32_t count) {
    TUBESIGHT_ASSERT(count >= 0 && count <= size_);
    size_ = count;
  }

  [[nodiscard]] constexpr T& operator[](std::int32_t index) {
    TUBESIGHT_ASSERT(index >= 0 && index < size_);
    return items_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] constexpr const T& operator[](std::int32_t index) const {
    TUBESIGHT_ASSERT(index >= 0 && index < size_);
    return items_[static_cast<std::size_t>(index)];
  }

  [[nodiscard]] constexpr T* begin() { return items_.data(); }
  [[nodiscard]] constexpr T* end() { return items_.data() + size_; }
  [[nodiscard]] constexpr const T* begin() const { return items_.data(); }
  [[nodiscard]] constexpr const T* end() const { return items_.data() + size_; }

  [[nodiscard]] constexpr std::span<const T> view() const {
    return {items_.data(), static_cast<std::size_t>(size_)};
  }

 private:
  std::array<T, static_cast<std::size_t>(Capacity)> items_{};
  std::int32_t size_ = 0;
};

}  // namespace tubesight::core
