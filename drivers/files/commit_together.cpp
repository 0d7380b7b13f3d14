#include "drivers/files/commit_together.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <unistd.h>

#include "drivers/files/atomic_file.h"
#include "drivers/files/unfinished.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

thread_local CommitTogether* of_this_thread = nullptr;

}  // namespace

CommitTogether::CommitTogether() { of_this_thread = this; }

CommitTogether* CommitTogether::current() { return of_this_thread; }

void CommitTogether::fail_current() {
  if (of_this_thread != nullptr) {
    of_this_thread->failed_ = true;
  }
}

Result<void> CommitTogether::commit() {
  if (failed_) {
    discard();
    return Unexpected(Error::kIo);
  }
  while (!waiting_.empty()) {
    const Waiting& file = waiting_.front();
    if (!rename_unfinished(file.temporary, file.target)) {
      return fail(file.path, "cannot be put in its place");
    }
    if (file.to_disk && !sync_folder(folder_of(file.target))) {
      return fail(file.path, "is in its place, but a power cut may take it back");
    }
    ::close(file.lock);
    waiting_.erase(waiting_.begin());
  }
  discard();
  return {};
}

void CommitTogether::discard() {
  for (const Waiting& file : waiting_) {
    ::unlink(file.temporary.c_str());
    forget_unfinished(file.temporary);
    ::close(file.lock);
  }
  waiting_.clear();
  if (of_this_thread == this) {
    of_this_thread = nullptr;
  }
}

Result<void> CommitTogether::fail(const std::string& path, const char* what) {
  message_ = path + ": " + what + ": " + std::strerror(errno);
  discard();
  return Unexpected(Error::kIo);
}

CommitAlone::CommitAlone() : suspended_(std::exchange(of_this_thread, nullptr)) {}

CommitAlone::~CommitAlone() { of_this_thread = suspended_; }

}  // namespace tubesight::drivers
