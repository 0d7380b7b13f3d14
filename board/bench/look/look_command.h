#pragma once

#include <string>
#include <vector>

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight look`; an empty path is one that was not given.
struct LookOptions {
  std::vector<std::string> pictures;
  std::string csv;
  std::string overlay;
};

/// `tubesight look`: finds the lattice of dots or tube-ends in each picture, without any settings.
///
/// What is there goes to standard output, messages to standard error. A picture without a lattice
/// gives one line there and status kJobFailed; the others' rows are written all the same. When none
/// has one no file is written.
[[nodiscard]] ExitStatus run_look(const LookOptions& options);

}  // namespace tubesight::board
