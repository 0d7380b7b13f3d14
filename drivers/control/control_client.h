#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace tubesight::drivers {

/// Asks a box over its control socket, one line at a time.
class ControlConnection {
 public:
  ControlConnection() = default;
  ControlConnection(const ControlConnection&) = delete;
  ControlConnection& operator=(const ControlConnection&) = delete;
  ~ControlConnection();

  /// Errors, with message(): kDisconnected nobody listens there, kIo the system refused.
  [[nodiscard]] core::Result<void> open(const std::string& path);

  /// Sends a line (without its feed) and waits for the answer, at most `timeout` between two pieces
  /// of it. Errors, with message(): kTimeout, kDisconnected the box went, kIo.
  [[nodiscard]] core::Result<void> ask(std::string_view line, std::chrono::milliseconds timeout,
                                       std::string& answer);

  /// Why open() or ask() failed, in one line with the path.
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  core::Result<void> fail(core::Error error, const std::string& why);

  std::string path_;
  std::string message_;
  int fd_ = -1;
};

}  // namespace tubesight::drivers
