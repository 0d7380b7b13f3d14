#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace tubesight::drivers {

/// Puts the files of one job in their places together, or none of them.
///
/// While it lives, what AtomicFile::commit() of the same thread would put in its place waits for
/// commit() of this; it is flushed and closed already. One at a time in a thread.
class CommitTogether {
 public:
  CommitTogether();
  CommitTogether(const CommitTogether&) = delete;
  CommitTogether& operator=(const CommitTogether&) = delete;
  ~CommitTogether() { discard(); }

  /// Puts all in their places, in the order of their commits. Errors: kIo when one of them could
  /// not be written (which was told already), and nothing is put in its place; or when the system
  /// refuses a name: then message() tells, and those before it stay.
  [[nodiscard]] core::Result<void> commit();

  /// Removes what waits, and ends the waiting.
  void discard();

  /// Empty where the failure was told already.
  [[nodiscard]] const std::string& message() const { return message_; }

  /// That of this thread; null where there is none.
  [[nodiscard]] static CommitTogether* current();

  /// Tells that of this thread that an output failed: commit() will refuse. Nothing where there is
  /// none.
  static void fail_current();

  /// A written file under its unfinished name. `lock` is the descriptor that holds its lock, and
  /// is taken over; `to_disk`: the name is waited for, too.
  struct Waiting {
    std::string path;
    std::string temporary;
    std::string target;
    int lock = -1;
    bool to_disk = false;
  };
  void add(Waiting file) { waiting_.push_back(std::move(file)); }

 private:
  core::Result<void> fail(const std::string& path, const char* what);

  std::vector<Waiting> waiting_;
  std::string message_;
  bool failed_ = false;
};

/// While this lives, files of this thread are put in their places at once all the same: those that
/// are put together in another way.
class CommitAlone {
 public:
  CommitAlone();
  CommitAlone(const CommitAlone&) = delete;
  CommitAlone& operator=(const CommitAlone&) = delete;
  ~CommitAlone();

 private:
  CommitTogether* suspended_;
};

}  // namespace tubesight::drivers
