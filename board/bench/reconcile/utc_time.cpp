#include "board/bench/reconcile/utc_time.h"

#include <cstdint>
#include <ratio>

#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

/// Takes so many digits off the front.
bool take_digits(std::string_view& text, std::size_t count, std::int32_t& value) {
  if (text.size() < count) {
    return false;
  }
  value = 0;
  for (const char digit : text.substr(0, count)) {
    if (digit < '0' || digit > '9') {
      return false;
    }
    value = 10 * value + (digit - '0');
  }
  text.remove_prefix(count);
  return true;
}

bool take(std::string_view& text, std::string_view one_of) {
  if (text.empty() || one_of.find(text.front()) == std::string_view::npos) {
    return false;
  }
  text.remove_prefix(1);
  return true;
}

/// ".5", ".25" or ".125"; nothing is nought.
bool take_fraction(std::string_view& text, std::int32_t& milliseconds) {
  milliseconds = 0;
  if (!take(text, ".")) {
    return true;
  }
  std::int32_t weight = 100;
  while (weight > 0 && !text.empty() && text.front() >= '0' && text.front() <= '9') {
    milliseconds += weight * (text.front() - '0');
    weight /= 10;
    text.remove_prefix(1);
  }
  return weight < 100;
}

}  // namespace

std::optional<UtcTime> parse_utc(std::string_view text) {
  std::int32_t year = 0;
  std::int32_t month = 0;
  std::int32_t day = 0;
  std::int32_t hour = 0;
  std::int32_t minute = 0;
  std::int32_t second = 0;
  std::int32_t milliseconds = 0;
  const bool whole = take_digits(text, 4, year) && take(text, "-") && take_digits(text, 2, month) &&
                     take(text, "-") && take_digits(text, 2, day) && take(text, "T ") &&
                     take_digits(text, 2, hour) && take(text, ":") &&
                     take_digits(text, 2, minute) && take(text, ":") &&
                     take_digits(text, 2, second) && take_fraction(text, milliseconds) &&
                     (text.empty() || text == "Z");
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!whole || year < 1970 || !date.ok() || hour > 23 || minute > 59 || second > 59) {
    return {};
  }
  return std::chrono::sys_days(date) + std::chrono::hours(hour) + std::chrono::minutes(minute) +
         std::chrono::seconds(second) + std::chrono::milliseconds(milliseconds);
}

std::string utc_text(UtcTime time) {
  const auto days = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date{days};
  const std::chrono::hh_mm_ss clock{time - days};
  std::string text;
  drivers::print(text, "%04d-%02u-%02uT%02d:%02d:%02d.%03dZ", static_cast<int>(date.year()),
                 static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                 static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                 static_cast<int>(clock.seconds().count()),
                 static_cast<int>(clock.subseconds().count()));
  return text;
}

}  // namespace tubesight::board
