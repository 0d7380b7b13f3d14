#include "drivers/journal/synced_file.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::size_t kLargestSmallFile = 65536;

Unexpected fail(const std::string& path, const char* what, std::string& message) {
  const int code = errno;
  message = path + ": " + what + ": " + std::strerror(code);
  return Unexpected(code == EEXIST || code == ENOENT ? Error::kInvalidArgument : Error::kIo);
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t done = ::write(file, text.data(), text.size());
    if (done < 0 && errno == EINTR) {
      continue;
    }
    if (done <= 0) {
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(done));
  }
  return true;
}

}  // namespace

Result<void> sync_folder_of(const std::string& path, std::string& message) {
  const std::string folder = folder_of(path);
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0 || ::fsync(file) != 0) {
    const Unexpected not_synced = fail(folder, "cannot be synced", message);
    if (file >= 0) {
      ::close(file);
    }
    return not_synced;
  }
  ::close(file);
  return {};
}

Result<void> make_synced_file(const std::string& path, std::string_view text, unsigned permissions,
                              std::string& message) {
  // Beside its place first: a power cut leaves no half a file under the name.
  const std::string part = path + ".part";
  ::unlink(part.c_str());
  const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW,
                          static_cast<mode_t>(permissions));
  if (file < 0) {
    return fail(path, "cannot be made", message);
  }
  const bool written = write_all(file, text) && ::fsync(file) == 0;
  const Unexpected not_written =
      written ? Unexpected(Error::kIo) : fail(path, "cannot be written", message);
  ::close(file);
  if (!written) {
    ::unlink(part.c_str());
    return not_written;
  }
  // A link is refused where the name is taken; a rename would replace what is there.
  if (::link(part.c_str(), path.c_str()) != 0) {
    const Unexpected taken = fail(path, "cannot be made", message);
    ::unlink(part.c_str());
    return taken;
  }
  ::unlink(part.c_str());
  return sync_folder_of(path, message);
}

Result<void> move_synced(const std::string& from, const std::string& to, std::string& message) {
  if (::rename(from.c_str(), to.c_str()) != 0) {
    return fail(from, "cannot be moved", message);
  }
  return sync_folder_of(to, message);
}

Result<std::string> read_small_file(const std::string& path, std::string& message) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return fail(path, "cannot be opened", message);
  }
  std::string text;
  std::array<char, 4096> piece{};
  ssize_t got = 0;
  while (text.size() < kLargestSmallFile && (got = ::read(file, piece.data(), piece.size())) > 0) {
    text.append(piece.data(), static_cast<std::size_t>(got));
  }
  const Unexpected not_read =
      got < 0 ? fail(path, "cannot be read", message) : Unexpected(Error::kIo);
  ::close(file);
  if (got < 0) {
    return not_read;
  }
  return text;
}

}  // namespace tubesight::drivers
