#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace tubesight::board {

/// What a service manager has told a service through its environment.
struct ServiceEnvironment {
  std::string socket;                     ///< NOTIFY_SOCKET; empty: nobody listens
  std::chrono::microseconds watchdog{0};  ///< WATCHDOG_USEC of this process; 0: none
  std::string state_folder;               ///< STATE_DIRECTORY; empty: none
};

/// Of this process. A number that is none is none; so is one that is meant for another process.
[[nodiscard]] ServiceEnvironment service_environment();

/// Tells the service manager how the service is doing: systemd's protocol of datagrams, each some
/// lines of NAME=VALUE, to a socket in a folder or to an abstract one ("@...").
///
/// Whatever becomes of the socket, a send never waits and the box goes on; what could not be sent
/// is counted, and told when it begins and when it ends. Any thread.
class ServiceManager {
 public:
  using Tell = std::function<void(const std::string&)>;

  ServiceManager(const ServiceEnvironment& environment, Tell tell);
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;
  ~ServiceManager();

  /// Whether somebody was there at the start.
  [[nodiscard]] bool there() const { return !socket_.empty(); }
  /// Within which time feed() is due; 0: never.
  [[nodiscard]] std::chrono::microseconds watchdog() const { return watchdog_; }

  void say_ready() { send("READY=1"); }
  void say_stopping() { send("STOPPING=1"); }
  void feed() { send("WATCHDOG=1"); }
  /// One line for `systemctl status`.
  void say_status(const std::string& words) { send("STATUS=" + words); }

  /// Datagrams that could not be sent.
  [[nodiscard]] std::int64_t lost() const { return lost_; }

 private:
  void send(const std::string& text);

  std::string socket_;
  std::chrono::microseconds watchdog_;
  Tell tell_;
  int descriptor_ = -1;
  std::atomic<std::int64_t> lost_{0};
  std::atomic<bool> told_{false};
};

}  // namespace tubesight::board
