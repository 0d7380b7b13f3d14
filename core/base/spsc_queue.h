#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace tubesight::core {

/// Messages from one thread to one other, in order: a ring of fixed capacity.
///
/// Neither side ever waits for the other. One thread pushes, one thread pops (they may be the
/// same). Running full is a documented result: what finds no room stays with whoever has it. No
/// heap.
template <typename T, std::uint32_t Capacity>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);
  // The two counts run on through 2^32, so that full and empty differ; the place in the ring then
  // follows from a count only if Capacity divides 2^32.
  static_assert(Capacity > 0 && (Capacity & (Capacity - 1)) == 0, "a power of two");
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

 public:
  using value_type = T;

  SpscQueue() = default;
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  [[nodiscard]] static constexpr std::uint32_t capacity() { return Capacity; }

  /// Appends and says true, or says false when the queue is full. The pushing thread only.
  [[nodiscard]] bool try_push(const T& value) {
    const std::uint32_t pushed = pushed_.load(std::memory_order_relaxed);
    // Acquired: the place is free only once its last message was copied out.
    if (pushed - popped_.load(std::memory_order_acquire) == Capacity) {
      return false;
    }
    slots_[pushed % Capacity] = value;
    pushed_.store(pushed + 1, std::memory_order_release);
    return true;
  }

  /// Takes the oldest and says true, or says false when the queue is empty. The popping thread
  /// only.
  [[nodiscard]] bool try_pop(T& value) {
    const std::uint32_t popped = popped_.load(std::memory_order_relaxed);
    if (pushed_.load(std::memory_order_acquire) == popped) {
      return false;
    }
    value = slots_[popped % Capacity];
    popped_.store(popped + 1, std::memory_order_release);
    return true;
  }

  /// Messages waiting. Exact between calls of both sides; the popping thread may find more, the
  /// pushing thread less.
  [[nodiscard]] std::uint32_t size() const {
    // In this order: popped_ never overtakes a pushed_ that is read after it.
    const std::uint32_t popped = popped_.load(std::memory_order_acquire);
    return pushed_.load(std::memory_order_acquire) - popped;
  }

 private:
  std::array<T, Capacity> slots_{};
  std::atomic<std::uint32_t> pushed_{0};
  std::atomic<std::uint32_t> popped_{0};
};

}  // namespace tubesight::core
