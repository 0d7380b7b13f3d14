#pragma once

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// Reads the arguments of the program and runs the command that they name.
///
/// Help and version go to standard output; what is wrong goes to standard error in one line.
[[nodiscard]] ExitStatus run_command_line(int argc, const char* const* argv);

}  // namespace tubesight::board
