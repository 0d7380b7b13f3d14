#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace tubesight::core {

/// The latest value of one thread, for any number of others to read: a sequence lock.
///
/// The writer never waits and never learns of its readers; a reader that the writer overtakes tries
/// again a few times, and is told when it got nothing. Values are copied word by word through
/// atomics, so that reading while writing is no data race. No heap; T may be some kilobytes.
///
/// No fence is needed: the words themselves are released and acquired. Whoever reads a word of a
/// newer value also sees that the count had become odd before it, and throws the copy away.
template <typename T>
class Snapshot {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Copies that one read tries. A writer 60 times a second, at some microseconds a value, is met
  /// once at most, unless the reader has stopped it in the middle: then no number is enough.
  static constexpr int kAttempts = 16;

  Snapshot() = default;
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

  /// Makes `value` the latest. One thread at a time.
  void publish(const T& value) {
    const std::uint32_t count = count_.load(std::memory_order_relaxed);
    count_.store(count + 1, std::memory_order_relaxed);
    for (std::size_t i = 0; i < kWords; ++i) {
      std::uint32_t word = 0;
      std::memcpy(&word, bytes_of(value) + i * kWordBytes, bytes_in(i));
      words_[i].store(word, std::memory_order_release);
    }
    count_.store(count + 2, std::memory_order_release);
  }

  /// Copies the latest value. False when nothing was published yet, or when the writer was at work
  /// in each attempt; then `value` is not to be used. Any thread; never waits.
  [[nodiscard]] bool try_read(T& value) const {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::uint32_t before = count_.load(std::memory_order_acquire);
      if (before == 0) {
        return false;
      }
      if (before % 2 != 0) {
        continue;
      }
      for (std::size_t i = 0; i < kWords; ++i) {
        const std::uint32_t word = words_[i].load(std::memory_order_acquire);
        std::memcpy(bytes_of(value) + i * kWordBytes, &word, bytes_in(i));
      }
      if (count_.load(std::memory_order_relaxed) == before) {
        return true;
      }
    }
    return false;
  }

  /// Grows by one with each value published: whether there is a new one. Wraps at 2^31, after a
  /// year of 60 a second; only equality means anything.
  [[nodiscard]] std::uint32_t version() const { return count_.load(std::memory_order_acquire) / 2; }

 private:
  // 32-bit words: lock-free on every target, without a library for 64-bit atomics.
  static constexpr std::size_t kWordBytes = sizeof(std::uint32_t);
  static constexpr std::size_t kWords = (sizeof(T) + kWordBytes - 1) / kWordBytes;
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

  /// The last word may be half filled.
  static constexpr std::size_t bytes_in(std::size_t word) {
    return word + 1 < kWords ? kWordBytes : sizeof(T) - word * kWordBytes;
  }
  static unsigned char* bytes_of(T& value) { return reinterpret_cast<unsigned char*>(&value); }
  static const unsigned char* bytes_of(const T& value) {
    return reinterpret_cast<const unsigned char*>(&value);
  }

  std::atomic<std::uint32_t> count_{0};  ///< odd while a value is being written; 0: none yet
  std::array<std::atomic<std::uint32_t>, kWords> words_{};
};

}  // namespace tubesight::core
