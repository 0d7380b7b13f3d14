#pragma once

#include <string>
#include <vector>

namespace tubesight::board {

// What `tubesightctl` does for the page's files; each says 0, or what was wrong on standard error
// and 1.

/// Sets the password of a role in a file of them, which is made where there is none: read from
/// standard input, without echo and twice where that is a terminal.
[[nodiscard]] int set_page_password(const std::string& file, const std::string& role);

/// Writes a certificate for these names and its key, the key for its owner alone; neither file may
/// be there.
[[nodiscard]] int make_page_certificate(const std::string& certificate, const std::string& key,
                                        const std::vector<std::string>& names);

}  // namespace tubesight::board
