#pragma once

#include "board/bench/replay/replay_options.h"

namespace CLI {
class App;
}  // namespace CLI

namespace tubesight::board {

/// Adds `tubesight replay` to the command line; what is given goes to `options`.
CLI::App* add_replay(CLI::App& app, ReplayOptions& options);

}  // namespace tubesight::board
