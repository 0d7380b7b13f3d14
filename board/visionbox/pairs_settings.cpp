#include "board/visionbox/pairs_settings.h"

#include "board/visionbox/settings_path.h"
#include "drivers/files/pairs_file.h"

namespace tubesight::board {

void read_pairs(const drivers::SettingsDocument& document, drivers::TableReader& table,
                PairsSettings& pairs) {
  std::string file;
  if (!table.text("file", file)) {
    return;
  }
  if (file.empty()) {
    table.complain("file", "'', expected the path of a file of pairs, there or not");
    return;
  }
  pairs.file = from_its_folder(document, table, "file", file);
  if (const std::string why = drivers::why_no_pairs(pairs.file); !why.empty()) {
    table.complain("file", why);
  }
}

}  // namespace tubesight::board
