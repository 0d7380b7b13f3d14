#pragma once

#include "board/bench/journal/journal_command.h"

namespace CLI {
class App;
}  // namespace CLI

namespace tubesight::board {

/// Adds `tubesight journal` to the command line; what is given goes to `options`.
CLI::App* add_journal(CLI::App& app, JournalOptions& options);

}  // namespace tubesight::board
