#include "drivers/files/unfinished.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kFileMode = 0666;  // less the user's umask
constexpr mode_t kFolderMode = 0777;
constexpr int kAttempts = 1000;

struct Unfinished {
  std::mutex mutex;
  std::vector<std::string> paths;

  void forget(const std::string& path) {
    const auto at = std::find(paths.begin(), paths.end(), path);
    if (at != paths.end()) {
      paths.erase(at);
    }
  }
};

/// Never destroyed: a signal may come while the program ends.
Unfinished& unfinished() {
  static auto* const all = new Unfinished;
  return *all;
}

std::string absolute(const std::string& path) {
  std::error_code why;
  const fs::path whole = fs::absolute(path, why);
  return why ? path : whole.string();
}

/// Whether nobody else holds its lock; a file system that knows no locks vouches for nothing.
bool lock(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0; }

/// Whether the path still leads to what was opened: another program may have taken that away and
/// made its own.
bool is_at(const std::string& path, int descriptor) {
  struct stat opened {};
  struct stat there {};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &there) == 0 &&
         opened.st_dev == there.st_dev && opened.st_ino == there.st_ino;
}

/// Whether what was just made is ours: between its making and our lock, another program may have
/// taken it for a stray.
bool keep(const std::string& path, int descriptor) {
  return (lock(descriptor) || errno != EWOULDBLOCK) && is_at(path, descriptor);
}

/// Removes what a program left behind; false when somebody is at it.
bool remove_stray(const std::string& path, int open_flags) {
  const int descriptor = ::open(path.c_str(), open_flags | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) {
    return false;
  }
  const bool stray = lock(descriptor) && is_at(path, descriptor);
  std::error_code why;
  if (stray) {
    fs::remove_all(path, why);
  }
  ::close(descriptor);
  return stray && !why;
}

/// `make` makes what its path names and opens it; -1 and EEXIST where something is there.
template <typename Make>
int make_unfinished(const std::string& name, int flags_of_stray, Make make, std::string& path) {
  for (int number = 0; number < kAttempts;) {
    path = name + "." + std::to_string(number) + ".part";
    note_unfinished(path);
    const int descriptor = make(path.c_str());
    if (descriptor >= 0 && keep(path, descriptor)) {
      return descriptor;
    }
    const int why = errno;
    forget_unfinished(path);
    if (descriptor >= 0) {
      ::close(descriptor);
      ++number;
    } else if (why != EEXIST) {
      errno = why;
      return -1;
    } else if (!remove_stray(path, flags_of_stray)) {
      ++number;
    }
  }
  errno = EEXIST;
  return -1;
}

}  // namespace

void note_unfinished(const std::string& path) {
  Unfinished& all = unfinished();
  const std::lock_guard<std::mutex> guard(all.mutex);
  all.paths.push_back(absolute(path));
}

void forget_unfinished(const std::string& path) {
  Unfinished& all = unfinished();
  const std::lock_guard<std::mutex> guard(all.mutex);
  all.forget(absolute(path));
}

bool rename_unfinished(const std::string& path, const std::string& target) {
  Unfinished& all = unfinished();
  const std::lock_guard<std::mutex> guard(all.mutex);
  if (::rename(path.c_str(), target.c_str()) != 0) {
    return false;
  }
  all.forget(absolute(path));
  return true;
}

void remove_unfinished_for_good() {
  Unfinished& all = unfinished();
  all.mutex.lock();
  for (const std::string& path : all.paths) {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
}

int open_unfinished_beside(const std::string& target, std::string& path) {
  return make_unfinished(
      target, O_WRONLY,
      [](const char* name) {
        return ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kFileMode);
      },
      path);
}

int make_unfinished_folder(const std::string& name, std::string& path) {
  return make_unfinished(
      name, O_RDONLY | O_DIRECTORY,
      [](const char* folder) {
        return ::mkdir(folder, kFolderMode) != 0
                   ? -1
                   : ::open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      },
      path);
}

}  // namespace tubesight::drivers
