#pragma once

#include <initializer_list>
#include <span>
#include <string>

#include "core/base/result.h"
#include "drivers/files/atomic_file.h"

namespace tubesight::board {

/// A file and what it is to the user, for messages.
struct NamedPath {
  std::string name;
  std::string path;
};

/// Begins to write an output: a file, or standard output where `path` is "-". Errors: as
/// AtomicFile::open().
[[nodiscard]] core::Result<void> open_output(drivers::AtomicFile& file, const std::string& path);

/// Whether one of these outputs goes to standard output: text for a person then does not.
[[nodiscard]] bool goes_to_standard_output(std::initializer_list<std::string> paths);

/// A name's ending in small letters, ".png" or "" where it has none; ".y4m.xz" is one.
[[nodiscard]] std::string ending_of(const std::string& path);

/// Whether the ending of a name that is no folder yet says that it is to be a file of some kind
/// (".png", ".avi", ".csv"): no folder gets such a name by mistake.
[[nodiscard]] bool is_named_as_file(const std::string& path);

/// Says in one line why a PNG picture cannot go to `path`, the value of the option `name`: it is
/// named as something else. Empty when it can; a device may be named anyhow.
[[nodiscard]] std::string why_no_png(const std::string& name, const std::string& path);

/// Says in one line why outputs cannot go where they are told to: two to one place, or onto a file
/// that is read. Empty when they can. Empty paths are passed over.
///
/// "-" is standard output, which one output may have; standard input is no output's place. Pipes,
/// terminals and devices may be named as often as one likes.
[[nodiscard]] std::string find_clash(std::span<const NamedPath> inputs,
                                     std::span<const NamedPath> outputs);

}  // namespace tubesight::board
