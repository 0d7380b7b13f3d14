#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace tubesight::drivers {

/// Writes a file that appears under its name only when it is whole.
///
/// The bytes go to a file beside the target whose name ends in `.part`; commit() renames it, and
/// destruction without commit() removes it, so that the target is the old file, the whole new one,
/// or absent. What is no regular file (a pipe, a terminal, /dev/null) is written directly.
///
/// What an earlier program left behind of the same target, killed in the midst of it, is removed;
/// an end by remove_unfinished_for_good() leaves nothing. Under a CommitTogether the file gets its
/// name with those of the others.
class AtomicFile {
 public:
  AtomicFile() = default;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() { discard(); }

  /// Begins to write `path`; what an earlier open() began is discarded. Errors: kIo.
  [[nodiscard]] core::Result<void> open(const std::string& path);

  /// Begins to write to standard output, of which nothing can be taken back. Errors: kIo.
  [[nodiscard]] core::Result<void> open_standard_output();

  /// Appends bytes; they are collected and written in large pieces. Errors: kIo (the disk is full,
  /// say), kNotReady not open. After an error the file can only be discarded.
  [[nodiscard]] core::Result<void> write(std::string_view text);
  [[nodiscard]] core::Result<void> write(std::span<const std::byte> bytes);

  /// Hands all bytes so far to the system, which finds out then whether there is room for them: of
  /// several files that belong together none is put in its place before all have been flushed.
  /// Errors: kIo, kNotReady.
  [[nodiscard]] core::Result<void> flush();

  /// As flush(), and waits until the bytes are on the disk, so that they are there after a power
  /// cut once the file is in its place. As slow as the disk. Errors: kIo, kNotReady.
  [[nodiscard]] core::Result<void> sync();

  /// Writes the rest and puts the file in its place. Errors: kIo, kNotReady; the target is then as
  /// it was before open().
  [[nodiscard]] core::Result<void> commit();

  /// As commit(), and when it returns the file is in its place after a power cut, too: its bytes
  /// are on the disk before it gets its name, and then the name. For what is kept (settings,
  /// calibrations, pairs): a name without its bytes may come back as an empty file. As slow as the
  /// disk. Errors: kIo, kNotReady; the target is then as it was before open(), but where the last
  /// step alone failed: then it is the whole new file, which a power cut may take back.
  [[nodiscard]] core::Result<void> commit_to_disk();

  /// Gives up what was written; does nothing when not open.
  void discard();

  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }

  /// The file that stands in for the target until commit(), for programs that write it; empty when
  /// it is written directly, or not open.
  [[nodiscard]] const std::string& temporary() const { return temporary_; }

  /// The last failure in one line, with the target's name.
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  core::Result<void> commit(bool to_disk);
  core::Result<void> fail(const char* what);

  std::string path_;       ///< as the caller gave it
  std::string target_;     ///< where the rename goes: path_ with symbolic links resolved
  std::string temporary_;  ///< empty when written directly
  std::string buffer_;
  std::string message_;
  int descriptor_ = -1;
  bool failed_ = false;
};

/// The folder that a path leads into: "." of a bare name.
[[nodiscard]] std::string folder_of(const std::string& path);

/// Waits until the names of a folder's files are on the disk: what was put in its place or removed
/// there is so after a power cut. False when the system refuses.
[[nodiscard]] bool sync_folder(const std::string& folder);

}  // namespace tubesight::drivers
