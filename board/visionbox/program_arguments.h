#pragma once

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace tubesight::board {

/// Exit status of a program whose arguments or settings are wrong.
inline constexpr int kWrongInput = 2;

/// Reads a program's arguments. None: it goes on; else it ends with this exit status, as help or
/// version were asked for and printed (0), or as an argument is wrong, which is told in one line
/// (kWrongInput).
///
/// Of the programs alone, not of the library: CLI11's templates are slow to compile.
[[nodiscard]] inline std::optional<int> read_arguments(CLI::App& app, int argc,
                                                       const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      return app.exit(problem) == 0 ? 0 : kWrongInput;
    }
    std::string text = problem.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    std::fprintf(stderr, "%s: %s (%s --help tells the arguments)\n", app.get_name().c_str(),
                 text.c_str(), app.get_name().c_str());
    return kWrongInput;
  }
  return std::nullopt;
}

}  // namespace tubesight::board
