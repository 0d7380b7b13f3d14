#include "drivers/files/atomic_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "drivers/files/commit_together.h"
#include "drivers/files/unfinished.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::size_t kBufferBytes = 65536;

std::string resolve_links(const std::string& path) {
  char* const resolved = ::realpath(path.c_str(), nullptr);
  if (resolved == nullptr) {
    return path;
  }
  std::string result = resolved;
  std::free(resolved);
  return result;
}

}  // namespace

Result<void> AtomicFile::open(const std::string& path) {
  discard();
  path_ = path;
  buffer_.clear();
  buffer_.reserve(kBufferBytes);
  message_.clear();
  failed_ = false;
  temporary_.clear();
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) {
      errno = EISDIR;
      return fail("cannot be written");
    }
    if (!S_ISREG(status.st_mode)) {
      descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
      return descriptor_ < 0 ? fail("cannot be written") : Result<void>();
    }
  }
  target_ = resolve_links(path);
  descriptor_ = open_unfinished_beside(target_, temporary_);
  if (descriptor_ < 0) {
    temporary_.clear();
    return fail("cannot be written");
  }
  return {};
}

Result<void> AtomicFile::open_standard_output() {
  discard();
  path_ = "standard output";
  buffer_.clear();
  buffer_.reserve(kBufferBytes);
  message_.clear();
  failed_ = false;
  temporary_.clear();
  descriptor_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
  return descriptor_ < 0 ? fail("cannot be written") : Result<void>();
}

Result<void> AtomicFile::write(std::string_view text) {
  return write(std::as_bytes(std::span(text.data(), text.size())));
}

Result<void> AtomicFile::write(std::span<const std::byte> bytes) {
  if (!is_open()) {
    return Unexpected(Error::kNotReady);
  }
  buffer_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return buffer_.size() < kBufferBytes ? Result<void>() : flush();
}

Result<void> AtomicFile::sync() {
  TUBESIGHT_TRY(flush());
  if (::fsync(descriptor_) != 0 && errno != EINVAL) {  // EINVAL: a pipe, which keeps nothing
    return fail("cannot be written");
  }
  return {};
}

Result<void> AtomicFile::commit() { return commit(false); }

Result<void> AtomicFile::commit_to_disk() {
  if (const auto synced = sync(); !synced) {
    discard();
    return synced;
  }
  return commit(true);
}

Result<void> AtomicFile::commit(bool to_disk) {
  if (!is_open()) {
    return Unexpected(Error::kNotReady);
  }
  if (const auto flushed = flush(); !flushed) {
    discard();
    return flushed;
  }
  // The copy keeps the lock until the file has its name: nobody takes it for one left behind.
  const int copy = ::dup(descriptor_);
  const int closed = ::close(descriptor_);
  descriptor_ = copy;
  if (closed != 0) {
    const auto failure = fail("cannot be written");
    discard();
    return failure;
  }
  if (temporary_.empty()) {  // written directly
    discard();
    return {};
  }
  if (CommitTogether* const together = CommitTogether::current(); together != nullptr) {
    together->add({path_, temporary_, target_, descriptor_, to_disk});
    temporary_.clear();
    descriptor_ = -1;
    return {};
  }
  if (!rename_unfinished(temporary_, target_)) {
    const auto failure = fail("cannot be put in its place");
    discard();
    return failure;
  }
  temporary_.clear();
  discard();
  if (to_disk && !sync_folder(folder_of(target_))) {
    return fail("is in its place, but a power cut may take it back");
  }
  return {};
}

void AtomicFile::discard() {
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
    forget_unfinished(temporary_);
    temporary_.clear();
  }
  if (descriptor_ >= 0) {
    ::close(descriptor_);
    descriptor_ = -1;
  }
}

Result<void> AtomicFile::fail(const char* what) {
  if (!failed_) {
    message_ = path_ + ": " + what + ": " + std::strerror(errno);
  }
  failed_ = true;
  CommitTogether::fail_current();
  return Unexpected(Error::kIo);
}

Result<void> AtomicFile::flush() {
  if (!is_open()) {
    return Unexpected(Error::kNotReady);
  }
  if (failed_) {
    return Unexpected(Error::kIo);
  }
  std::size_t written = 0;
  while (written < buffer_.size()) {
    const ssize_t count = ::write(descriptor_, buffer_.data() + written, buffer_.size() - written);
    if (count >= 0) {
      written += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      return fail("cannot be written");
    }
  }
  buffer_.clear();
  return {};
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

bool sync_folder(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) {
    return false;
  }
  const bool synced = ::fsync(descriptor) == 0;
  ::close(descriptor);
  return synced;
}

}  // namespace tubesight::drivers
