#pragma once

#include <array>
#include <charconv>
#include <string>

#include <CLI/CLI.hpp>

namespace tubesight::board {

/// 0.05, -500, 4000000000: no zeros that say nothing, no exponent.
[[nodiscard]] inline std::string number_as_written(double value) {
  std::array<char, 400> text{};  // any double
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return {text.data(), end.ptr};
}

/// Takes a number from `least` to `most`. CLI::Range asks whether a number is beyond its limits,
/// which nan never is.
[[nodiscard]] inline CLI::Validator number_between(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        double value = 0.0;
        return CLI::detail::lexical_cast(text, value) && value >= least && value <= most
                   ? std::string()
                   : "Value " + text + " not in range " + number_as_written(least) + " to " +
                         number_as_written(most);
      },
      "");
}

}  // namespace tubesight::board
