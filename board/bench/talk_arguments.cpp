#include "board/bench/talk_arguments.h"

#include <CLI/CLI.hpp>

#include "board/bench/output/text_output.h"

namespace tubesight::board {

void add_talk(CLI::App& command) {
  CLI::Option* const quiet = command.add_flag_callback(
      "-q,--quiet", [] { set_talk(Talk::kQuiet); },
      "Print neither results for people nor progress; messages alone");
  command
      .add_flag_callback(
          "-v,--verbose", [] { set_talk(Talk::kVerbose); }, "Tell what is read, and how")
      ->excludes(quiet);
}

}  // namespace tubesight::board
