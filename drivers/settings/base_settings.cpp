#include "drivers/settings/base_settings.h"

#include <limits>

#include "drivers/settings/read_table.h"
#include "drivers/settings/session_keys.h"
#include "drivers/settings/session_settings.h"
#include "drivers/settings/session_tables.h"

namespace tubesight::drivers {
namespace {

constexpr NumberRange kAnyNumber{std::numeric_limits<double>::lowest(),
                                 std::numeric_limits<double>::max(), ""};

}  // namespace

void read_base(TableReader& table, BaseSettings& base) {
  table.numbers("position_mm", kAnyNumber, base.position_mm);
  table.numbers("rotation_deg", kAngle, base.rotation_deg);
}

void read_base(TableReader& table) {
  BaseSettings ignored;
  read_base(table, ignored);
}

core::Result<void> load_base_settings(const std::string& path, BaseSettings& base,
                                      Messages& messages) {
  DiskFiles files;
  SettingsDocument document;
  document.load(files, path, kSessionTables);
  read_table(document, "base", true, [&](TableReader& table) { read_base(table, base); });
  return document.report(messages);
}

}  // namespace tubesight::drivers
