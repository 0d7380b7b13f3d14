#pragma once

#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace tubesight::tests {

/// What a run of the program left.
struct ProgramRun {
  int status = -1;  ///< exit status; -1 when it was ended by a signal
  std::string out;
  std::string err;
};

/// Runs the built program, in an emulator where it is built for another machine.
///
/// `folder` becomes the working folder, so that relative names lead there. `input` is a file there
/// that the program gets as its standard input; without one it is ours.
[[nodiscard]] ProgramRun run_tubesight(const support::TemporaryFolder& folder,
                                       const std::vector<std::string>& arguments,
                                       const std::string& input = {});

}  // namespace tubesight::tests
