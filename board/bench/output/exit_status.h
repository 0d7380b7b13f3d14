#pragma once

#include <cstdint>

namespace tubesight::board {

/// What the program tells its caller.
enum class ExitStatus : std::uint8_t {
  kDone = 0,        ///< the job is done, all outputs are in their places
  kJobFailed = 1,   ///< an output cannot be written, or memory ran out
  kWrongInput = 2,  ///< the arguments or a file are wrong
  kNotTracked = 3,  ///< what was to be tracked (`--must-track`) never started, or was lost
};

}  // namespace tubesight::board
