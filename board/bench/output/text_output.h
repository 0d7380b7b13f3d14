#pragma once

#include <string>
#include <vector>

namespace tubesight::board {

/// Messages for a person, a line each, to standard error.
void tell(const std::string& message);
void tell(const std::vector<std::string>& messages);

/// Writes results for a person to standard output; says false, and why to standard error, when they
/// did not get there.
[[nodiscard]] bool write_out(const std::string& text);

/// Appends to `out` as std::printf writes, up to 499 bytes.
[[gnu::format(printf, 2, 3)]] void print(std::string& out, const char* format, ...);

}  // namespace tubesight::board
