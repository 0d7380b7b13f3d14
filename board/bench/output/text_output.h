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

}  // namespace tubesight::board
