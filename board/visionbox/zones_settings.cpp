#include "board/visionbox/zones_settings.h"

#include <vector>

#include "board/visionbox/settings_path.h"
#include "drivers/files/zones_file.h"
#include "drivers/settings/text_files.h"

namespace tubesight::board {

void read_zones(const drivers::SettingsDocument& document, drivers::TableReader& table, bool link,
                ZonesSettings& zones) {
  std::string name;
  if (!table.text("file", name)) {
    return;
  }
  if (!link) {
    table.complain("file", "of a robot's link, which is \"none\", expected it left out");
    return;
  }
  zones.file = from_its_folder(document, table, "file", name);
  drivers::DiskFiles files;
  std::string text;
  std::string message;
  if (!files.read(zones.file, text, message)) {
    table.complain("file", "'" + zones.file + "' cannot be read: " + message);
    return;
  }
  std::vector<drivers::ZoneRow> rows;
  drivers::Messages messages;
  static_cast<void>(drivers::read_zone_rows(
      text, zones.file, static_cast<std::size_t>(core::calibration::kMaxZones), rows, messages));
  for (const std::string& each : messages) {
    table.complain("file", each);
  }
  if (messages.empty() && rows.empty()) {
    table.complain("file", "'" + zones.file + "' has no corrections, expected one at least");
  }
  for (const drivers::ZoneRow& row : rows) {
    // As many as were read have room.
    static_cast<void>(zones.points.try_push_back(
        core::calibration::zone_point(row.at_mm, row.off_mm, row.sigma_mm)));
  }
}

}  // namespace tubesight::board
