#pragma once

#include <cstdint>
#include <string>

namespace tubesight::board {

/// The arguments of `tubesight simulate`.
struct SimulateOptions {
  std::string scenario;
  std::string out;
  std::int64_t seed = -1;    ///< below 0: the scenario's
  bool window_only = false;  ///< draw the search window and a margin alone
};

}  // namespace tubesight::board
