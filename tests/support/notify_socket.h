#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace tubesight::support {

/// The socket at which a service manager listens: a path, or an abstract name ("@...").
class NotifySocket {
 public:
  explicit NotifySocket(std::string name) : name_(std::move(name)) {
    descriptor_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name_.copy(address.sun_path, sizeof address.sun_path - 1);
    if (name_[0] == '@') {
      address.sun_path[0] = '\0';
    }
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name_.size() +
                                               (name_[0] == '@' ? 0 : 1));
    EXPECT_EQ(bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), length), 0);
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;
  ~NotifySocket() { close(); }

  /// Nobody listens any more.
  void close() {
    if (descriptor_ >= 0) {
      ::close(descriptor_);
      descriptor_ = -1;
      if (name_[0] == '/') {
        unlink(name_.c_str());
      }
    }
  }

  [[nodiscard]] const std::string& name() const { return name_; }

  /// The next datagram; empty: none came in time.
  [[nodiscard]] std::string next(std::chrono::milliseconds timeout) const {
    pollfd wait{descriptor_, POLLIN, 0};
    poll(&wait, 1, static_cast<int>(timeout.count()));
    std::array<char, 4096> text{};
    const ssize_t count = recv(descriptor_, text.data(), text.size(), 0);
    return count > 0 ? std::string(text.data(), static_cast<std::size_t>(count)) : std::string();
  }

  /// Datagrams until one begins so, or until the time is over; whether it came.
  [[nodiscard]] bool hears(const std::string& begin, std::chrono::milliseconds timeout) const {
    const auto until = std::chrono::steady_clock::now() + timeout;
    while (std::chrono::steady_clock::now() < until) {
      if (next(std::chrono::milliseconds(20)).starts_with(begin)) {
        return true;
      }
    }
    return false;
  }

 private:
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace tubesight::support
