#pragma once

#include <string>
#include <vector>

namespace tubesight::board {

/// Messages for a person, a line each, to standard error.
void tell(const std::string& message);
void tell(const std::vector<std::string>& messages);

/// Writes results for a person to standard output, or to standard error where `taken`: an output of
/// the command goes to standard output. Says false, and why to standard error, when they did not
/// get there.
[[nodiscard]] bool write_out(const std::string& text, bool taken = false);

}  // namespace tubesight::board
