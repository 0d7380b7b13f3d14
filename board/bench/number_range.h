#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace tubesight::board {

/// Takes a number from `least` to `most`. CLI::Range asks whether a number is beyond its limits,
/// which nan never is.
[[nodiscard]] inline CLI::Validator number_between(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        double value = 0.0;
        return CLI::detail::lexical_cast(text, value) && value >= least && value <= most
                   ? std::string()
                   : "Value " + text + " not in range " + std::to_string(least) + " to " +
                         std::to_string(most);
      },
      "");
}

}  // namespace tubesight::board
