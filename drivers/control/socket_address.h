#pragma once

#include <optional>
#include <string>

#include <sys/un.h>

namespace tubesight::drivers {

/// The address of a socket in the file system; empty where the path is empty or too long for one
/// (107 bytes).
[[nodiscard]] std::optional<sockaddr_un> socket_address(const std::string& path);

/// A connection to whoever listens there, or -1 with errno as connect() left it.
[[nodiscard]] int connect_to(const std::string& path);

}  // namespace tubesight::drivers
