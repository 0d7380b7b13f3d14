#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <sqlite3.h>

namespace tubesight::support {

/// What reached the file system, or was told meanwhile.
struct DiskEvent {
  enum class Kind : std::uint8_t { kWrite, kTruncate, kSync, kDelete, kSafe };
  Kind kind = Kind::kWrite;
  std::string file;     ///< its path
  std::int64_t at = 0;  ///< offset of a write, size of what is cut off, number of the safe row
  std::string bytes;    ///< written; of a safe row its chain
};

/// A file system of SQLite that logs what it is told to write, in order, and can fail on demand.
/// It stands on the usual one. Registered under name() while it lives.
class RecordingVfs {
 public:
  RecordingVfs();
  RecordingVfs(const RecordingVfs&) = delete;
  RecordingVfs& operator=(const RecordingVfs&) = delete;
  ~RecordingVfs();

  [[nodiscard]] const std::string& name() const { return name_; }

  /// The row of that number, with that chain, is told to be safe now.
  void tell_safe(std::int64_t number, const std::string& chain) {
    events_.push_back({DiskEvent::Kind::kSafe, {}, number, chain});
  }

  /// Writes fail from now on with a full disk, or no more.
  void set_full(bool full) { full_ = full; }
  /// Syncs fail from now on, or no more.
  void set_syncs_fail(bool fail) { syncs_fail_ = fail; }
  /// Syncs are left out from now on and said to be done.
  void leave_out_syncs() { no_syncs_ = true; }

  [[nodiscard]] const std::vector<DiskEvent>& events() const { return events_; }

 private:
  struct File;
  static int open(sqlite3_vfs* vfs, const char* path, sqlite3_file* file, int flags, int* out);
  static int remove(sqlite3_vfs* vfs, const char* path, int sync_folder);
  static const sqlite3_io_methods& methods();
  static void log_changes(sqlite3_io_methods& m);
  static void pass_on_the_rest(sqlite3_io_methods& m);

  std::string name_;
  sqlite3_vfs* base_ = nullptr;
  sqlite3_vfs vfs_{};
  bool full_ = false;
  bool syncs_fail_ = false;
  bool no_syncs_ = false;
  std::vector<DiskEvent> events_;
};

/// The files as a power cut after the first `events` of a log leaves them: what was synced is
/// there, and of the rest each write, with `loss`, is there, lost or there in part; without, it is
/// there.
[[nodiscard]] std::map<std::string, std::string> files_after_cut(const std::vector<DiskEvent>& log,
                                                                 std::size_t events, bool loss,
                                                                 std::mt19937_64& random);

}  // namespace tubesight::support
