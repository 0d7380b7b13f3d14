#include "board/visionbox/service_manager.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace tubesight::board {
namespace {

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

/// 0 where there is no such number.
std::int64_t number_of(const std::string& text) {
  std::int64_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = problem == std::errc() && end == text.data() + text.size();
  return whole && value > 0 ? value : 0;
}

/// The address of a socket, and how long it is; 0: there is no such address.
socklen_t address_of(const std::string& path, sockaddr_un& address) {
  address = {};
  address.sun_family = AF_UNIX;
  const bool abstract = path.starts_with('@');
  if ((!abstract && !path.starts_with('/')) || path.size() < 2 ||
      path.size() >= sizeof address.sun_path) {
    return 0;
  }
  path.copy(address.sun_path, path.size());
  if (abstract) {
    address.sun_path[0] = '\0';
  }
  // An abstract name is as long as it is; one of a file ends with a zero.
  return static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path.size() + (abstract ? 0 : 1));
}

}  // namespace

ServiceEnvironment service_environment() {
  ServiceEnvironment told;
  told.socket = environment("NOTIFY_SOCKET");
  const std::string process = environment("WATCHDOG_PID");
  if (process.empty() || number_of(process) == getpid()) {
    told.watchdog = std::chrono::microseconds(number_of(environment("WATCHDOG_USEC")));
  }
  // Of several the first.
  told.state_folder = environment("STATE_DIRECTORY");
  told.state_folder.resize(std::min(told.state_folder.size(), told.state_folder.find(':')));
  return told;
}

ServiceManager::ServiceManager(const ServiceEnvironment& environment, Tell tell)
    : socket_(environment.socket),
      watchdog_(environment.socket.empty() ? std::chrono::microseconds(0) : environment.watchdog),
      tell_(std::move(tell)) {
  if (there()) {
    descriptor_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  }
}

ServiceManager::~ServiceManager() {
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
}

void ServiceManager::send(const std::string& text) {
  if (!there()) {
    return;
  }
  sockaddr_un address{};
  const socklen_t length = address_of(socket_, address);
  const bool sent =
      length > 0 && sendto(descriptor_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                           reinterpret_cast<const sockaddr*>(&address), length) >= 0;
  if (sent) {
    if (told_.exchange(false)) {
      tell_("service manager: hears the box again");
    }
    return;
  }
  const std::string why = length == 0 ? "no path and no abstract name" : std::strerror(errno);
  ++lost_;
  if (!told_.exchange(true)) {
    tell_("service manager: cannot be told how the box is doing: NOTIFY_SOCKET=" + socket_ + ": " +
          why + "; the box goes on");
  }
}

}  // namespace tubesight::board
