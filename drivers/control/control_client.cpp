#include "drivers/control/control_client.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/control/socket_address.h"

namespace tubesight::drivers {

using core::Error;
using core::Result;
using core::Unexpected;

ControlConnection::~ControlConnection() {
  if (fd_ >= 0) {
    close(fd_);
  }
}

Result<void> ControlConnection::fail(Error error, const std::string& why) {
  message_ = path_ + ": " + why;
  return Unexpected(error);
}

Result<void> ControlConnection::open(const std::string& path) {
  path_ = path;
  fd_ = connect_to(path);
  if (fd_ >= 0) {
    return {};
  }
  if (errno == ENOENT || errno == ECONNREFUSED) {
    return fail(Error::kDisconnected, "no box listens there");
  }
  return fail(Error::kIo, "cannot be connected to: " + std::string(std::strerror(errno)));
}

Result<void> ControlConnection::ask(std::string_view line, std::chrono::milliseconds timeout,
                                    std::string& answer) {
  const std::string asked = std::string(line) + '\n';
  if (send(fd_, asked.data(), asked.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(asked.size())) {
    return fail(Error::kDisconnected, "the box does not listen any more");
  }
  answer.clear();
  while (answer.empty() || answer.back() != '\n') {
    pollfd wanted{fd_, POLLIN, 0};
    const int ready = poll(&wanted, 1, static_cast<int>(timeout.count()));
    if (ready == 0) {
      return fail(Error::kTimeout, "the box did not answer in time");
    }
    std::array<char, 4096> bytes;
    const ssize_t got = ready < 0 ? -1 : recv(fd_, bytes.data(), bytes.size(), 0);
    if (got > 0) {
      answer.append(bytes.data(), static_cast<std::size_t>(got));
    } else if (got == 0) {
      return fail(Error::kDisconnected, "the box went without an answer");
    } else if (errno != EINTR) {
      return fail(Error::kIo, "cannot be read: " + std::string(std::strerror(errno)));
    }
  }
  answer.pop_back();
  return {};
}

}  // namespace tubesight::drivers
