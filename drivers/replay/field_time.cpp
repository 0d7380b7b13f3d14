#include "drivers/replay/field_time.h"

#include <algorithm>
#include <limits>

#include "core/base/assert.h"

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

}  // namespace tubesight::drivers
