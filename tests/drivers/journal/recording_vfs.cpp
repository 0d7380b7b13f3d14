#include "tests/drivers/journal/recording_vfs.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace tubesight::support {
namespace {

constexpr std::size_t kSector = 512;

/// As much of a write as a power cut in the midst of it leaves: whole sectors from its beginning.
std::size_t torn(std::size_t size, std::mt19937_64& random) {
  return random() % (size / kSector + 1) * kSector;
}

void write_into(std::string& content, std::size_t at, std::string_view bytes) {
  content.resize(std::max(content.size(), at + bytes.size()));
  content.replace(at, bytes.size(), bytes);
}

}  // namespace

/// SQLite makes room for it and hands it back: the usual file stands behind it in the same memory.
struct RecordingVfs::File {
  sqlite3_file head;
  RecordingVfs* owner;
  std::string* path;

  static File& of(sqlite3_file* file) { return *static_cast<File*>(static_cast<void*>(file)); }
  static constexpr int bytes() { return (static_cast<int>(sizeof(File)) + 15) / 16 * 16; }
  static sqlite3_file* real(sqlite3_file* file) {
    return static_cast<sqlite3_file*>(
        static_cast<void*>(static_cast<char*>(static_cast<void*>(file)) + bytes()));
  }
};

RecordingVfs::RecordingVfs() : base_(sqlite3_vfs_find(nullptr)) {
  static std::atomic<int> made{0};
  name_ = "recording-" + std::to_string(++made);
  vfs_ = *base_;
  vfs_.szOsFile = File::bytes() + base_->szOsFile;
  vfs_.zName = name_.c_str();
  vfs_.pAppData = this;
  vfs_.xOpen = &RecordingVfs::open;
  vfs_.xDelete = &RecordingVfs::remove;
  sqlite3_vfs_register(&vfs_, 0);
}

RecordingVfs::~RecordingVfs() { sqlite3_vfs_unregister(&vfs_); }

int RecordingVfs::open(sqlite3_vfs* vfs, const char* path, sqlite3_file* file, int flags,
                       int* out) {
  auto* const self = static_cast<RecordingVfs*>(vfs->pAppData);
  file->pMethods = nullptr;
  const int code = self->base_->xOpen(self->base_, path, File::real(file), flags, out);
  if (code == SQLITE_OK) {
    File::of(file).owner = self;
    File::of(file).path = new std::string(path == nullptr ? "" : path);
    file->pMethods = &methods();
  }
  return code;
}

int RecordingVfs::remove(sqlite3_vfs* vfs, const char* path, int sync_folder) {
  auto* const self = static_cast<RecordingVfs*>(vfs->pAppData);
  self->events_.push_back({DiskEvent::Kind::kDelete, path, 0, {}});
  return self->base_->xDelete(self->base_, path, sync_folder);
}

void RecordingVfs::log_changes(sqlite3_io_methods& m) {
  m.xWrite = [](sqlite3_file* file, const void* from, int size, sqlite3_int64 at) {
    RecordingVfs& owner = *File::of(file).owner;
    if (owner.full_) {
      return SQLITE_FULL;
    }
    owner.events_.push_back(
        {DiskEvent::Kind::kWrite, *File::of(file).path, at,
         std::string(static_cast<const char*>(from), static_cast<std::size_t>(size))});
    return File::real(file)->pMethods->xWrite(File::real(file), from, size, at);
  };
  m.xTruncate = [](sqlite3_file* file, sqlite3_int64 size) {
    File::of(file).owner->events_.push_back(
        {DiskEvent::Kind::kTruncate, *File::of(file).path, size, {}});
    return File::real(file)->pMethods->xTruncate(File::real(file), size);
  };
  m.xSync = [](sqlite3_file* file, int) {
    // Nothing is synced here: what the log says stands for the disk.
    RecordingVfs& owner = *File::of(file).owner;
    if (owner.syncs_fail_) {
      return SQLITE_IOERR_FSYNC;
    }
    if (!owner.no_syncs_) {
      owner.events_.push_back({DiskEvent::Kind::kSync, *File::of(file).path, 0, {}});
    }
    return SQLITE_OK;
  };
}

void RecordingVfs::pass_on_the_rest(sqlite3_io_methods& m) {
  m.xClose = [](sqlite3_file* file) {
    delete File::of(file).path;
    return File::real(file)->pMethods->xClose(File::real(file));
  };
  m.xRead = [](sqlite3_file* file, void* to, int size, sqlite3_int64 at) {
    return File::real(file)->pMethods->xRead(File::real(file), to, size, at);
  };
  m.xFileSize = [](sqlite3_file* file, sqlite3_int64* size) {
    return File::real(file)->pMethods->xFileSize(File::real(file), size);
  };
  m.xLock = [](sqlite3_file* file, int level) {
    return File::real(file)->pMethods->xLock(File::real(file), level);
  };
  m.xUnlock = [](sqlite3_file* file, int level) {
    return File::real(file)->pMethods->xUnlock(File::real(file), level);
  };
  m.xCheckReservedLock = [](sqlite3_file* file, int* held) {
    return File::real(file)->pMethods->xCheckReservedLock(File::real(file), held);
  };
  m.xFileControl = [](sqlite3_file* file, int what, void* with) {
    return File::real(file)->pMethods->xFileControl(File::real(file), what, with);
  };
  m.xSectorSize = [](sqlite3_file* file) {
    return File::real(file)->pMethods->xSectorSize(File::real(file));
  };
  m.xDeviceCharacteristics = [](sqlite3_file* file) {
    return File::real(file)->pMethods->xDeviceCharacteristics(File::real(file));
  };
  m.xShmMap = [](sqlite3_file* file, int page, int size, int extend, void volatile** to) {
    return File::real(file)->pMethods->xShmMap(File::real(file), page, size, extend, to);
  };
  m.xShmLock = [](sqlite3_file* file, int first, int count, int flags) {
    return File::real(file)->pMethods->xShmLock(File::real(file), first, count, flags);
  };
  m.xShmBarrier = [](sqlite3_file* file) {
    File::real(file)->pMethods->xShmBarrier(File::real(file));
  };
  m.xShmUnmap = [](sqlite3_file* file, int drop) {
    return File::real(file)->pMethods->xShmUnmap(File::real(file), drop);
  };
}

const sqlite3_io_methods& RecordingVfs::methods() {
  static const sqlite3_io_methods kMethods = [] {
    sqlite3_io_methods m{};
    m.iVersion = 2;  // without memory mapping, which writes behind our back
    log_changes(m);
    pass_on_the_rest(m);
    return m;
  }();
  return kMethods;
}

std::map<std::string, std::string> files_after_cut(const std::vector<DiskEvent>& log,
                                                   std::size_t events, bool loss,
                                                   std::mt19937_64& random) {
  std::map<std::string, std::size_t> synced;  // where each file's last sync stands in the log
  for (std::size_t i = 0; i < events; ++i) {
    if (log[i].kind == DiskEvent::Kind::kSync) {
      synced[log[i].file] = i + 1;
    }
  }
  std::map<std::string, std::string> files;
  for (std::size_t i = 0; i < events; ++i) {
    const DiskEvent& event = log[i];
    const bool safe = !loss || (synced.contains(event.file) && i < synced[event.file]);
    const auto at = static_cast<std::size_t>(event.at);
    if (event.kind == DiskEvent::Kind::kDelete) {
      files.erase(event.file);
    } else if (event.kind == DiskEvent::Kind::kTruncate && (safe || random() % 2 == 0)) {
      files[event.file].resize(at);
    } else if (event.kind == DiskEvent::Kind::kWrite) {
      const std::uint64_t fate = safe ? 0 : random() % 4;  // of four: two whole, one lost, one torn
      const std::size_t size = fate < 2    ? event.bytes.size()
                               : fate == 2 ? 0
                                           : torn(event.bytes.size(), random);
      if (size > 0) {
        write_into(files[event.file], at, std::string_view(event.bytes).substr(0, size));
      }
    }
  }
  return files;
}

}  // namespace tubesight::support
