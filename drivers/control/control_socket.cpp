#include "drivers/control/control_socket.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "drivers/control/socket_address.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// Owner and group may talk to the box, nobody else.
constexpr mode_t kMode = 0660;
/// Clients that may wait to be accepted.
constexpr int kWaiting = 16;

/// While it lives, no other program that asks for it passes: between the look at an old socket and
/// its replacement somebody else would do the same. The folder itself is what is locked, so that
/// nothing is left behind, and the system lets go of it whatever becomes of the program.
class FolderLock {
 public:
  explicit FolderLock(const std::string& path) {
    std::string folder = std::filesystem::path(path).parent_path().string();
    fd_ = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    held_ = fd_ >= 0 && flock(fd_, LOCK_EX | LOCK_NB) == 0;
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() {
    if (fd_ >= 0) {
      close(fd_);
    }
  }
  [[nodiscard]] bool there() const { return fd_ >= 0; }
  [[nodiscard]] bool held() const { return held_; }

 private:
  int fd_ = -1;
  bool held_ = false;
};

}  // namespace

Result<void> ControlSocket::fail(Error error, const std::string& why) {
  message_ = path_ + ": " + why;
  return Unexpected(error);
}

Result<void> ControlSocket::open(const std::string& path) {
  if (fd_ >= 0) {
    return fail(Error::kNotReady, "is open already");
  }
  path_ = path;
  if (!socket_address(path)) {
    return fail(Error::kInvalidArgument, "no path for a socket, expected 1 to 107 bytes");
  }
  const FolderLock lock(path);
  if (!lock.there()) {
    return fail(Error::kIo, "its folder cannot be opened: " + std::string(std::strerror(errno)));
  }
  if (!lock.held()) {
    return fail(Error::kNotReady, "another program is opening a socket there");
  }
  TUBESIGHT_TRY(clear_the_way(path));
  return listen_at(path);
}

Result<void> ControlSocket::clear_the_way(const std::string& path) {
  struct stat there {};
  if (lstat(path.c_str(), &there) != 0) {
    return {};
  }
  if (!S_ISSOCK(there.st_mode)) {
    return fail(Error::kInvalidArgument, "something else stands there, expected a socket or none");
  }
  const int other = connect_to(path);
  if (other >= 0 || errno != ECONNREFUSED) {
    if (other >= 0) {
      ::close(other);
    }
    return fail(Error::kNotReady, "another program listens there");
  }
  if (unlink(path.c_str()) != 0) {
    return fail(Error::kIo,
                "an old socket cannot be removed: " + std::string(std::strerror(errno)));
  }
  return {};
}

Result<void> ControlSocket::listen_at(const std::string& path) {
  const auto address = socket_address(path);
  fd_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd_ < 0) {
    return fail(Error::kIo, "no socket to be had: " + std::string(std::strerror(errno)));
  }
  // Nobody can connect before listen(), so the mode is in force for the first client.
  if (bind(fd_, reinterpret_cast<const sockaddr*>(&*address), sizeof(*address)) != 0) {
    const std::string why = std::strerror(errno);
    ::close(fd_);
    fd_ = -1;
    return fail(Error::kIo, "cannot be made: " + why);
  }
  if (chmod(path.c_str(), kMode) != 0 || listen(fd_, kWaiting) != 0) {
    const std::string why = std::strerror(errno);
    close();
    return fail(Error::kIo, "cannot be listened on: " + why);
  }
  return {};
}

void ControlSocket::close() {
  if (fd_ < 0) {
    return;
  }
  ::close(fd_);
  fd_ = -1;
  static_cast<void>(unlink(path_.c_str()));
}

}  // namespace tubesight::drivers
