#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace tubesight::core {

/// Digest of a sequence by FNV-1a with 64 bits (draft-eastlake-fnv): the same on every machine. It
/// tells whether something has changed; it is no protection against a forger. One multiplication a
/// byte.
class Fnv1a {
 public:
  constexpr void add(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
      step(byte);
    }
  }
  constexpr void add(std::string_view text) {
    for (const char letter : text) {
      step(static_cast<std::uint8_t>(letter));
    }
  }
  /// The number's eight bytes, the lowest first.
  constexpr void add(std::int64_t number) {
    for (int byte = 0; byte < 8; ++byte) {
      step((static_cast<std::uint64_t>(number) >> (8 * byte)) & 0xFFU);
    }
  }
  /// The number in one step, an eighth of the cost: not the digest of its bytes.
  constexpr void step(std::uint64_t number) { value_ = (value_ ^ number) * kPrime; }

  [[nodiscard]] constexpr std::uint64_t value() const { return value_; }

 private:
  static constexpr std::uint64_t kPrime = 1099511628211U;

  std::uint64_t value_ = 14695981039346656037U;
};

}  // namespace tubesight::core
