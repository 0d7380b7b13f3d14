#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "hal/recording_store.h"

namespace tubesight::drivers {

/// The word of a reason in names: `disagreement`, `track-lost`, `command`.
[[nodiscard]] std::string_view word_of(hal::RecordingReason reason);

/// That no other recorder on this machine has the same folder, by whatever path.
///
/// It is held by an abstract socket named after the folder's device and inode: nothing lies in the
/// folder for it, and the system lets go of it whatever becomes of the program. Another machine, or
/// another network namespace, is not seen.
class FolderClaim {
 public:
  enum class Outcome : std::uint8_t {
    kHeld,
    kTaken,   ///< somebody else holds it
    kFailed,  ///< `errno` says why
  };

  FolderClaim() = default;
  FolderClaim(const FolderClaim&) = delete;
  FolderClaim& operator=(const FolderClaim&) = delete;
  ~FolderClaim() { release(); }

  /// Lets go of what was held before.
  [[nodiscard]] Outcome take(const std::string& folder);
  void release();

 private:
  int fd_ = -1;
};

/// A folder that holds recordings among whatever else: knows its own by their names, keeps their
/// sum within a bound, and touches nothing else.
///
/// A recording is `box-NNNNNN-YYYYMMDDTHHMMSSZ-REASON` with the endings of kEndings. NNNNNN counts
/// on from the largest number there, so that the oldest is known whatever a clock says that begins
/// in 1970.
class RecordingFolder {
 public:
  /// The picture comes last: a recording without it is the remains of one.
  static constexpr std::string_view kEndings[] = {".meta.csv", ".events.csv", ".session.toml",
                                                  ".state", ".y4m"};

  /// What a folder's disk has free, in bytes; 0 where nobody knows.
  using FreeBytes = std::function<std::int64_t(const std::string& folder)>;
  [[nodiscard]] static std::int64_t free_on_disk(const std::string& folder);

  /// `most_bytes`: of all recordings together. `free` is asked of the system unless a test says it.
  RecordingFolder(std::string folder, std::int64_t most_bytes, FreeBytes free = free_on_disk)
      : folder_(std::move(folder)), most_bytes_(most_bytes), free_(std::move(free)) {}

  /// Claims the folder until the end of this object, looks what is there, and removes the remains
  /// of recordings that a box was stopped in. May be called again. Errors: kNotReady another box
  /// records there; kIo the folder is not there or cannot be read. Nothing is removed then.
  [[nodiscard]] core::Result<void> open();

  /// Removes the oldest recordings until `bytes` more have room, within the bound and on the disk.
  /// Errors: kOutOfRange the bound is smaller; kIo all recordings together are smaller and the disk
  /// is full, and then none is removed; kIo the folder cannot be read or a recording not be
  /// removed.
  [[nodiscard]] core::Result<void> make_room(std::int64_t bytes);

  /// Room for the next recording, bytes: what is free and what older ones would leave. Errors: kIo.
  [[nodiscard]] core::Result<std::int64_t> room();

  /// The path, without ending, of the next recording; `utc_s`: seconds since 1970. Each call counts
  /// on.
  [[nodiscard]] std::string next_path(std::int64_t utc_s, hal::RecordingReason reason);

  /// Removes the files of a recording, whichever are there.
  void remove(const std::string& path) const;

  /// Waits until what was put there or removed is so on the disk. Errors: kIo.
  [[nodiscard]] core::Result<void> sync();

  /// Why the last call failed, in one line.
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  struct Entry {
    std::int64_t number = 0;
    std::string name;  ///< without ending
    std::int64_t bytes = 0;
    bool has_picture = false;
  };

  [[nodiscard]] core::Result<void> list(std::vector<Entry>& entries, bool remove_unfinished);
  [[nodiscard]] std::string path_of(const std::string& name) const { return folder_ + "/" + name; }
  core::Result<void> fail(core::Error error, std::string message);

  std::string folder_;
  FolderClaim claim_;
  std::int64_t most_bytes_;
  FreeBytes free_;
  std::int64_t last_number_ = 0;
  std::string message_;
};

}  // namespace tubesight::drivers
