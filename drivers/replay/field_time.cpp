#include "drivers/replay/field_time.h"

#include <algorithm>
#include <limits>

#include "core/base/assert.h"
#include "drivers/files/decimal.h"

namespace tubesight::drivers {

core::FieldTime nominal_field_time(std::int64_t number, std::int64_t rate_numerator,
                                   std::int64_t rate_denominator) {
  constexpr std::int64_t kLargestPart = 1'000'000'000;
  TUBESIGHT_ASSERT(number >= 0 && number <= (std::int64_t{1} << 33));
  TUBESIGHT_ASSERT(rate_numerator >= 1 && rate_numerator <= kLargestPart);
  TUBESIGHT_ASSERT(rate_denominator >= 1 && rate_denominator <= kLargestPart);
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  constexpr std::int64_t kMostSeconds = std::numeric_limits<std::int64_t>::max() / kNanoseconds - 1;
  // Seconds are number * denominator / (2 * numerator): the product is at most 2^33 * 10^9 < 2^63,
  // and the rest, below 2 * 10^9, times 2 * 10^9 stays below 2^63 as well.
  const std::int64_t divisor = 2 * rate_numerator;
  const std::int64_t product = number * rate_denominator;
  const std::int64_t seconds = std::min(product / divisor, kMostSeconds);
  const std::int64_t rest = product % divisor;
  const std::int64_t nanoseconds = (2 * rest * kNanoseconds + divisor) / (2 * divisor);
  return core::FieldTime(seconds * kNanoseconds + nanoseconds);
}

bool parse_time(std::string_view text, core::FieldTime& time, const char*& expected) {
  constexpr std::int32_t kDecimals = 9;
  constexpr std::int64_t kLargestTime_ns = 4'000'000'000'000'000'000;
  std::int64_t time_ns = 0;
  if (parse_decimal(text, kDecimals, time_ns)) {
    expected = "at most 4000000000 s to either side of zero";
    if (time_ns < -kLargestTime_ns || time_ns > kLargestTime_ns) {
      return false;
    }
    time = core::FieldTime(time_ns);
    return true;
  }
  // Right in its form as far as its point, the number is too large.
  const std::string_view whole = text.substr(0, text.find('.'));
  const std::string_view digits = whole.substr(whole.starts_with('-') ? 1 : 0);
  std::int64_t ignored = 0;
  const bool form =
      !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos &&
      (whole.size() == text.size() || parse_decimal(text.substr(whole.size()), kDecimals, ignored));
  expected =
      form ? "at most 4000000000 s to either side of zero" : "seconds with at most 9 decimals";
  return false;
}

}  // namespace tubesight::drivers
