#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace tubesight::board {

/// An instant by the wall clock, UTC.
using UtcTime = std::chrono::sys_time<std::chrono::milliseconds>;

/// Reads "2026-12-01T03:04:05Z", also with a blank in place of the T, a fraction of up to three
/// digits, and without the Z; the years 1970 to 9999. Empty for anything else, other zones too.
[[nodiscard]] std::optional<UtcTime> parse_utc(std::string_view text);

/// "2026-12-01T03:04:05.678Z".
[[nodiscard]] std::string utc_text(UtcTime time);

}  // namespace tubesight::board
