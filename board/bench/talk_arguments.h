#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace tubesight::board {

/// Adds `-q` and `-v` to a command: the same words with the same meaning everywhere. They set
/// board::talk().
void add_talk(CLI::App& command);

}  // namespace tubesight::board
