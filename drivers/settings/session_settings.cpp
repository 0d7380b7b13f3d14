#include "drivers/settings/session_settings.h"

#include <array>
#include <string_view>

#include "drivers/files/byte_source.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/session_tables.h"
#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::drivers {
namespace {

using core::Result;

constexpr std::array<std::string_view, 10> kTables = {
    "camera", "camera_quality", "tool",  "tool_quality", "tubesheet",
    "start",  "motion",         "edges", "verification", "base"};

class DiskFiles final : public TextFiles {
 public:
  Result<void> read(const std::string& path, std::string& text, std::string& message) override {
    // The longest lists of tubes take some 300 KB.
    constexpr std::size_t kLargestFile = std::size_t{16} << 20;
    return read_whole_file(path, kLargestFile, text, message);
  }
};

/// Reads one table by `read_table` where it stands; a needed one that is missing is a mistake. Says
/// whether it was there and without mistakes.
template <typename ReadTable>
bool read(SettingsDocument& document, std::string_view name, bool needed, ReadTable read_table) {
  const SettingsTable* const table = document.find(name);
  if (table == nullptr) {
    if (needed && document.complete()) {
      document.problems().push_back({{},
                                     std::string(name) + ": the table is missing, expected [" +
                                         std::string(name) + "] here or in an included file"});
    }
    return false;
  }
  if (!table->node->is_table()) {
    document.problems().push_back(
        {table->place,
         std::string(name) + ": a list of tables, expected [" + std::string(name) + "] once"});
    return false;
  }
  const std::size_t before = document.problems().size();
  TableReader reader(*table->node->as_table(), table->place, std::string(name),
                     document.problems());
  read_table(reader);
  reader.finish();
  return document.problems().size() == before;
}

void read_all(SettingsDocument& document, NeededTables needed, SessionFile& session) {
  core::SessionSettings& to = session.settings;
  const bool camera = read(document, "camera", needed.camera,
                           [&](TableReader& table) { read_camera(table, to.camera); });
  if (camera) {
    // Without a start, everything may be looked at.
    to.start.window_px = {0, 0, to.camera.width_px - 1, to.camera.height_px - 1};
    to.start.optimum_px = {(to.camera.width_px - 1) / 2.0, (to.camera.height_px - 1) / 2.0};
  }
  read(document, "tool", needed.tool, [&](TableReader& table) { read_tool(table, to.tool); });
  const bool tubesheet = read(document, "tubesheet", needed.tubesheet,
                              [&](TableReader& table) { read_tubesheet(table, to.tubesheet); });
  // What relates the start to other tables can be judged only when these are sound.
  const StartContext context{camera ? &to.camera : nullptr, tubesheet ? &to.tubesheet : nullptr};
  read(document, "start", needed.start,
       [&](TableReader& table) { read_start(table, context, to.start); });
  read(document, "motion", false, [&](TableReader& table) { read_motion(table, to.motion); });
  read(document, "edges", false, [&](TableReader& table) { read_edges(table, to.edges); });
  read(document, "verification", false,
       [&](TableReader& table) { read_verification(table, to.verification); });
  read(document, "camera_quality", false,
       [&](TableReader& table) { read_quality(table, session.camera_quality); });
  read(document, "tool_quality", false,
       [&](TableReader& table) { read_quality(table, session.tool_quality); });
  read(document, "base", false, [&](TableReader& table) { read_base(table); });
}

}  // namespace

Result<void> load_session_settings(const std::string& path, NeededTables needed,
                                   SessionFile& session, Messages& messages) {
  DiskFiles files;
  return load_session_settings(files, path, needed, session, messages);
}

Result<void> load_session_settings(TextFiles& files, const std::string& path, NeededTables needed,
                                   SessionFile& session, Messages& messages) {
  // Member by member: a temporary of the whole would lie on the stack.
  session.settings.camera = {};
  session.settings.tool = {};
  session.settings.tubesheet.missing.clear();
  session.settings.tubesheet.plugged.clear();
  session.settings.start = {};
  session.settings.motion = {};
  session.settings.edges = {};
  session.settings.verification = {};
  session.camera_quality = {};
  session.tool_quality = {};
  SettingsDocument document;
  document.load(files, path, kTables);
  read_all(document, needed, session);
  session.has_tool = document.find("tool") != nullptr;
  session.has_start = document.find("start") != nullptr;
  return document.report(messages);
}

}  // namespace tubesight::drivers
