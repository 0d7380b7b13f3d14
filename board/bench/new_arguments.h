#pragma once

#include "board/bench/new/new_command.h"

namespace CLI {
class App;
}  // namespace CLI

namespace tubesight::board {

/// Adds `tubesight new` to the command line; what is given goes to `options`.
CLI::App* add_new(CLI::App& app, NewOptions& options);

}  // namespace tubesight::board
