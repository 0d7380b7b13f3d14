#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "board/box/recorder_memory.h"
#include "core/base/settings.h"
#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {

/// The table `[record]`.
struct RecordSettings {
  std::string folder;  ///< empty: nothing is recorded
  std::int32_t disk_mb = 2000;
  RecorderSettings recorder;

  [[nodiscard]] bool wanted() const { return !folder.empty(); }
};

/// Reads the table; the folder is not looked for.
void read_record(const drivers::SettingsDocument& document, drivers::TableReader& table,
                 RecordSettings& record);

/// What is wrong with the memory for this camera, in words; empty when nothing is.
[[nodiscard]] std::string wrong_memory(const RecordSettings& record,
                                       const core::CameraSettings& camera);

/// What is wrong with it on a machine with so much memory: the recorder would take more than half.
/// Apart from the above, as settings are also checked on other machines than the box's.
[[nodiscard]] std::string too_much_memory(const RecordSettings& record, std::int64_t machine_mb);

/// Of this machine; 0: not known.
[[nodiscard]] std::int64_t machine_memory_mb();

}  // namespace tubesight::board
