#include "board/visionbox/record_settings.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include <unistd.h>

#include "board/visionbox/settings_path.h"
#include "core/base/scalar.h"
#include "core/session/session.h"

namespace tubesight::board {
namespace {

constexpr drivers::WholeRange kMemory{4, 65'536};
constexpr drivers::WholeRange kFieldsAfter{0, 100'000};
constexpr drivers::WholeRange kDisk{16, 10'000'000};

constexpr std::size_t kStateBytes = core::session::Session<core::FixedPoint>::state_bytes();

/// One that is not there may come, with its disk; what stands in its place never becomes one.
bool is_no_folder(const std::string& path) {
  std::error_code unknown;
  const auto there = std::filesystem::status(path, unknown);
  return std::filesystem::exists(there) && !std::filesystem::is_directory(there);
}

}  // namespace

void read_record(const drivers::SettingsDocument& document, drivers::TableReader& table,
                 RecordSettings& record) {
  std::string folder;
  if (table.text("folder", folder)) {
    record.folder = from_its_folder(document, table, "folder", folder);
    if (folder.empty()) {
      table.complain("folder", "'', expected the path of a folder");
    } else if (is_no_folder(record.folder)) {
      table.complain("folder", "'" + record.folder + "' is no folder, expected one, or none yet");
    }
  }
  table.optional_whole("memory_mb", kMemory, record.recorder.memory_mb);
  table.optional_whole("disk_mb", kDisk, record.disk_mb);
  table.optional_whole("fields_after", kFieldsAfter, record.recorder.fields_after);
  table.optional_switch("on_disagreement", record.recorder.on_disagreement);
  table.optional_switch("on_track_lost", record.recorder.on_track_lost);
  if (table.sound("memory_mb") && table.sound("disk_mb") &&
      record.disk_mb < record.recorder.memory_mb) {
    table.complain("disk_mb", std::to_string(record.disk_mb) +
                                  ", expected room for a recording of memory_mb = " +
                                  std::to_string(record.recorder.memory_mb));
  }
}

std::string wrong_memory(const RecordSettings& record, const core::CameraSettings& camera) {
  if (!record.wanted() || divide_memory(record.recorder, camera, kStateBytes)) {
    return {};
  }
  RecorderSettings without = record.recorder;
  without.fields_after = 0;
  const auto memory = divide_memory(without, camera, kStateBytes);
  const std::string memory_mb = std::to_string(record.recorder.memory_mb);
  if (memory) {
    return "record.fields_after: " + std::to_string(record.recorder.fields_after) +
           ", expected at most " + std::to_string(memory->capacity_fields() / 2) +
           ", half of the fields that memory_mb = " + memory_mb + " holds";
  }
  while (!divide_memory(without, camera, kStateBytes) && without.memory_mb < kMemory.most) {
    ++without.memory_mb;
  }
  return "record.memory_mb: " + memory_mb + ", expected at least " +
         std::to_string(without.memory_mb) + " for pictures of this size";
}

std::string too_much_memory(const RecordSettings& record, std::int64_t machine_mb) {
  const std::int64_t wanted = record.recorder.memory_mb;
  if (!record.wanted() || machine_mb <= 0 || wanted <= machine_mb / 2) {
    return {};
  }
  return "record.memory_mb: " + std::to_string(wanted) + ", expected at most " +
         std::to_string(machine_mb / 2) + ", half of this machine's memory";
}

std::int64_t machine_memory_mb() {
  constexpr std::int64_t kMb = 1024 * 1024;
  const std::int64_t pages = sysconf(_SC_PHYS_PAGES);
  const std::int64_t page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? pages * page / kMb : 0;
}

}  // namespace tubesight::board
