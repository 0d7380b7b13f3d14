#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/assert.h"

namespace tubesight::core::pose {

/// StaticVector for types that hold Eigen's matrices, which are not trivially copyable.
template <typename T, std::int32_t Capacity>
class FixedList {
 public:
  [[nodiscard]] static constexpr std::int32_t capacity() { return Capacity; }
  [[nodiscard]] std::int32_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }

  /// Appends and says true, or says false when the list is full.
  [[nodiscard]] bool try_push_back(const T& value) {
    if (size_ == Capacity) {
      return false;
    }
    items_[static_cast<std::size_t>(size_)] = value;
    ++size_;
    return true;
  }
  void clear() { size_ = 0; }
  /// Shortens the list to its first `count` elements.
  void truncate(std::int32_t count) {
    TUBESIGHT_ASSERT(count >= 0 && count <= size_);
    size_ = count;
  }

  [[nodiscard]] T& operator[](std::int32_t index) {
    TUBESIGHT_ASSERT(index >= 0 && index < size_);
    return items_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] const T& operator[](std::int32_t index) const {
    TUBESIGHT_ASSERT(index >= 0 && index < size_);
    return items_[static_cast<std::size_t>(index)];
  }

  [[nodiscard]] T* begin() { return items_.data(); }
  [[nodiscard]] T* end() { return items_.data() + size_; }
  [[nodiscard]] const T* begin() const { return items_.data(); }
  [[nodiscard]] const T* end() const { return items_.data() + size_; }

  [[nodiscard]] std::span<const T> view() const {
    return {items_.data(), static_cast<std::size_t>(size_)};
  }

 private:
  std::array<T, static_cast<std::size_t>(Capacity)> items_{};
  std::int32_t size_ = 0;
};

}  // namespace tubesight::core::pose
