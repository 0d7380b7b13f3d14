#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tubesight::drivers {

/// Appends numerator / denominator with exactly `digits` decimals, by integers alone.
///
/// Rounds half away from zero; what rounds to zero carries no sign. denominator 1..10^9, digits
/// 0..9; every numerator is served.
void append_decimal(std::string& out, std::int64_t numerator, std::int64_t denominator,
                    std::int32_t digits);

/// Appends as std::printf writes, up to 500 bytes.
[[gnu::format(printf, 2, 3)]] void print(std::string& out, const char* format, ...);

/// Appends a whole number.
void append_whole(std::string& out, std::int64_t value);

/// The shortest decimal that reads back as the same number; with an exponent below 10^-6 and from
/// 10^9 on, where a plain one would be a row of zeros.
[[nodiscard]] std::string number_text(double value);

/// For numbers that were calculated: so many significant digits, 1..9.
[[nodiscard]] std::string rounded_text(double value, int digits = 4);

/// Reads a decimal number ("-12", "3.5", ".5") as a multiple of 10^-digits, exactly.
///
/// False, and `value` as it was, when the text is anything else (spaces and exponents too), has
/// more decimals than `digits` (zeros may follow), or does not fit. digits 0..9.
[[nodiscard]] bool parse_decimal(std::string_view text, std::int32_t digits, std::int64_t& value);

}  // namespace tubesight::drivers
