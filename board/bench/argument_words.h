#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace tubesight::board {

/// Whether a word in the command's place names none, in one line with what may have been meant;
/// empty when it does.
[[nodiscard]] std::string why_no_command(const CLI::App& app, const std::string& word);

/// What is wrong with arguments that CLI11 refused, in one line: what was misspelt with what may
/// have been meant, what is missing with what it is.
[[nodiscard]] std::string explain_refusal(const CLI::App& app, const CLI::ParseError& problem);

/// What is wrong with arguments that it took: an option with an empty value, a file in the place
/// of one of another kind. Empty when nothing is known to be.
[[nodiscard]] std::string find_wrong_arguments(const CLI::App& command);

}  // namespace tubesight::board
