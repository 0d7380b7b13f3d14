#pragma once

#include <array>
#include <ctime>
#include <string>

namespace tubesight::board {

/// The wall clock now, UTC, as ISO 8601: for a person, and no more right than that clock.
[[nodiscard]] inline std::string wall_time_text() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

}  // namespace tubesight::board
