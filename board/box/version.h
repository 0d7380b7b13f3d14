#pragma once

#include <string>

namespace tubesight::board {

/// The release: "0.1.0".
[[nodiscard]] const char* program_version();

/// The commit that the program was built from, as `git describe` names it, with "-dirty" when files
/// had changed since; "unknown" when it was built outside a repository.
///
/// Written anew by every build (toolchain/write_commit.cmake): right after a commit, too.
[[nodiscard]] const char* program_commit();

/// The number formats in which the tracking path runs by default.
[[nodiscard]] std::string program_arithmetic();

/// What `--version` tells of the program `name`, a line each; the last without its end.
[[nodiscard]] std::string version_text(const std::string& name);

}  // namespace tubesight::board
