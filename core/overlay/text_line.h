#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace tubesight::core::overlay {

/// A line of text being put together, held inside the object.
///
/// The capacity covers the longest line of the readout, which is a reason in words and what to do
/// about it; running over is a programmer's mistake and asserts, as a number cut short would be a
/// wrong number.
class TextLine {
 public:
  static constexpr std::int32_t kCapacity = 160;

  /// Appends words as they are.
  TextLine& words(std::string_view text);

  /// Appends a whole number in decimal, with a minus sign where it is negative.
  TextLine& integer(std::int64_t value);

  /// Appends `value` * 10^-`decimals` with exactly that many decimals, 1..9; zero has no sign.
  TextLine& decimal(std::int64_t value, std::int32_t decimals);

  [[nodiscard]] std::string_view view() const {
    return {characters_.data(), static_cast<std::size_t>(size_)};
  }

 private:
  void append(char character);
  void digits(std::uint64_t magnitude, std::int32_t at_least);

  std::array<char, kCapacity> characters_{};
  std::int32_t size_ = 0;
};

/// `value` / `divisor` to the nearest integer, ties away from zero; `divisor` > 0.
[[nodiscard]] constexpr std::int64_t nearest_quotient(std::int64_t value, std::int64_t divisor) {
  const std::int64_t quotient = value / divisor;
  const std::int64_t rest = value % divisor;
  if (rest >= divisor - rest) {
    return quotient + 1;
  }
  return -rest >= divisor + rest ? quotient - 1 : quotient;
}

}  // namespace tubesight::core::overlay
