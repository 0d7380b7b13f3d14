#pragma once

#include <string>

#include "core/base/result.h"

namespace tubesight::drivers {

/// A listening socket in the file system, mode 0660, gone again at close().
///
/// A socket that a killed program left behind is replaced; one that somebody listens on is not
/// touched, nor is anything that is no socket.
class ControlSocket {
 public:
  ControlSocket() = default;
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;
  ~ControlSocket() { close(); }

  /// Errors, each with a message(): kInvalidArgument the path is too long or something else stands
  /// there, kNotReady another program listens or is about to, kIo the system refused.
  [[nodiscard]] core::Result<void> open(const std::string& path);

  /// Stops listening and removes the socket, if it still is the one of open().
  void close();

  /// The descriptor to accept on; -1 when closed. It never blocks.
  [[nodiscard]] int fd() const { return fd_; }

  /// Why open() failed, in one line with the path.
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  core::Result<void> fail(core::Error error, const std::string& why);
  core::Result<void> clear_the_way(const std::string& path);
  core::Result<void> listen_at(const std::string& path);

  std::string path_;
  std::string message_;
  int fd_ = -1;
};

}  // namespace tubesight::drivers
