#pragma once

#include <span>
#include <string>

namespace tubesight::board {

/// A file and what it is to the user, for messages.
struct NamedPath {
  std::string name;
  std::string path;
};

/// Says in one line why outputs cannot go where they are told to: two to one place, or onto a file
/// that is read. Empty when they can. Empty paths are passed over.
///
/// Pipes, terminals and devices may be named as often as one likes.
[[nodiscard]] std::string find_clash(std::span<const NamedPath> inputs,
                                     std::span<const NamedPath> outputs);

}  // namespace tubesight::board
