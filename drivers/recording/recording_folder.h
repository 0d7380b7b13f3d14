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

  /// Looks what is there, and removes the remains of recordings that a box was stopped in. Errors:
  /// kIo the folder is not there or cannot be read.
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
  std::int64_t most_bytes_;
  FreeBytes free_;
  std::int64_t last_number_ = 0;
  std::string message_;
};

}  // namespace tubesight::drivers
