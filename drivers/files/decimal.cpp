#include "drivers/files/decimal.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

#include "core/base/assert.h"

namespace tubesight::drivers {
namespace {

std::uint64_t power_of_ten(std::int32_t exponent) {
  std::uint64_t power = 1;
  for (std::int32_t i = 0; i < exponent; ++i) {
    power *= 10;
  }
  return power;
}

void append_unsigned(std::string& out, std::uint64_t value, std::size_t least_digits) {
  char text[20];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  const auto length = static_cast<std::size_t>(end - text);
  if (length < least_digits) {
    out.append(least_digits - length, '0');
  }
  out.append(text, length);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

void append_decimal(std::string& out, std::int64_t numerator, std::int64_t denominator,
                    std::int32_t digits) {
  TUBESIGHT_ASSERT(denominator > 0 && denominator <= 1'000'000'000 && digits >= 0 && digits <= 9);
  const bool negative = numerator < 0;
  // Negating the most negative number is only defined without a sign.
  const std::uint64_t magnitude = negative
                                      ? std::uint64_t{0} - static_cast<std::uint64_t>(numerator)
                                      : static_cast<std::uint64_t>(numerator);
  const auto divisor = static_cast<std::uint64_t>(denominator);
  const std::uint64_t scale = power_of_ten(digits);
  std::uint64_t whole = magnitude / divisor;
  // remainder < 10^9 and scale <= 10^9: twice their product stays below 2^64.
  const std::uint64_t remainder = magnitude % divisor;
  std::uint64_t fraction = (2 * remainder * scale + divisor) / (2 * divisor);
  if (fraction == scale) {
    ++whole;
    fraction = 0;
  }
  if (negative && (whole != 0 || fraction != 0)) {
    out += '-';
  }
  append_unsigned(out, whole, 1);
  if (digits > 0) {
    out += '.';
    append_unsigned(out, fraction, static_cast<std::size_t>(digits));
  }
}

void print(std::string& out, const char* format, ...) {
  std::array<char, 500> text{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  out += text.data();
}

void append_whole(std::string& out, std::int64_t value) { append_decimal(out, value, 1, 0); }

std::string number_text(double value) {
  // Beyond these a plain decimal would be a row of zeros.
  constexpr double kSmallest = 1e-6;
  constexpr double kLargest = 1e9;
  const double magnitude = std::abs(value);
  const bool plain = value == 0.0 || (magnitude >= kSmallest && magnitude < kLargest);
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value,
                                 plain ? std::chars_format::fixed : std::chars_format::general)
                       .ptr;
  return {text, end};
}

std::string rounded_text(double value, int digits) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return {text, end};
}

bool parse_decimal(std::string_view text, std::int32_t digits, std::int64_t& value) {
  TUBESIGHT_ASSERT(digits >= 0 && digits <= 9);
  const bool negative = text.starts_with('-');
  if (negative) {
    text.remove_prefix(1);
  }
  constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
  std::int64_t number = 0;
  std::int32_t decimals = 0;
  bool in_fraction = false;
  bool any_digit = false;
  for (const char c : text) {
    if (c == '.' && !in_fraction) {
      in_fraction = true;
      continue;
    }
    if (!is_digit(c)) {
      return false;
    }
    any_digit = true;
    if (in_fraction && decimals == digits) {
      if (c != '0') {
        return false;
      }
      continue;
    }
    decimals += in_fraction ? 1 : 0;
    if (number > (kLargest - (c - '0')) / 10) {
      return false;
    }
    number = 10 * number + (c - '0');
  }
  for (; decimals < digits; ++decimals) {
    if (number > kLargest / 10) {
      return false;
    }
    number *= 10;
  }
  if (!any_digit) {
    return false;
  }
  value = negative ? -number : number;
  return true;
}

}  // namespace tubesight::drivers
