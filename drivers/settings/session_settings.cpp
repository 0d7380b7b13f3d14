#include "drivers/settings/session_settings.h"

#include "drivers/settings/read_table.h"
#include "drivers/settings/session_tables.h"
#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"
#include "drivers/settings/text_files.h"

namespace tubesight::drivers {
namespace {

using core::Result;

void read_all(SettingsDocument& document, NeededTables needed, SessionFile& session) {
  core::SessionSettings& to = session.settings;
  const bool camera = read_table(document, "camera", needed.camera,
                                 [&](TableReader& table) { read_camera(table, to.camera); });
  if (camera) {
    // Without a start, everything may be looked at.
    to.start.window_px = {0, 0, to.camera.width_px - 1, to.camera.height_px - 1};
    to.start.optimum_px = {(to.camera.width_px - 1) / 2.0, (to.camera.height_px - 1) / 2.0};
  }
  read_table(document, "tool", needed.tool, [&](TableReader& table) { read_tool(table, to.tool); });
  const bool tubesheet =
      read_table(document, "tubesheet", needed.tubesheet,
                 [&](TableReader& table) { read_tubesheet(table, to.tubesheet); });
  // What relates the start to other tables can be judged only when these are sound.
  const StartContext context{camera ? &to.camera : nullptr, tubesheet ? &to.tubesheet : nullptr};
  read_table(document, "start", needed.start, [&](TableReader& table) {
    read_start(table, context, needed.few_clicks ? 0 : 3, to.start);
    read_heading(table, session.heading_deg);
  });
  read_table(document, "motion", false, [&](TableReader& table) { read_motion(table, to.motion); });
  read_table(document, "edges", false, [&](TableReader& table) { read_edges(table, to.edges); });
  read_table(document, "verification", false,
             [&](TableReader& table) { read_verification(table, to.verification); });
  read_table(document, "camera_quality", false,
             [&](TableReader& table) { read_quality(table, session.camera_quality); });
  read_table(document, "tool_quality", false,
             [&](TableReader& table) { read_quality(table, session.tool_quality); });
  read_table(document, "base", false, [&](TableReader& table) { read_base(table); });
  read_table(document, "base_quality", false,
             [&](TableReader& table) { read_quality(table, session.base_quality); });
  read_table(document, "silhouette", false,
             [&](TableReader& table) { read_silhouette(table, session.silhouette); });
}

}  // namespace

void read_session(SettingsDocument& document, NeededTables needed, SessionFile& session) {
  // Member by member: a temporary of the whole would lie on the stack.
  session.settings.camera = {};
  session.settings.tool = {};
  session.settings.tubesheet.missing.clear();
  session.settings.tubesheet.plugged.clear();
  session.settings.start = {};
  session.heading_deg.reset();
  session.settings.motion = {};
  session.settings.edges = {};
  session.settings.verification = {};
  session.camera_quality = {};
  session.tool_quality = {};
  session.base_quality = {};
  session.silhouette = {};
  read_all(document, needed, session);
  session.has_tool = document.find("tool") != nullptr;
  session.has_start = document.find("start") != nullptr;
}

Result<void> load_session_settings(const std::string& path, NeededTables needed,
                                   SessionFile& session, Messages& messages) {
  DiskFiles files;
  return load_session_settings(files, path, needed, session, messages);
}

Result<void> load_session_settings(TextFiles& files, const std::string& path, NeededTables needed,
                                   SessionFile& session, Messages& messages) {
  SettingsDocument document;
  document.load(files, path, kSessionTables);
  read_session(document, needed, session);
  session.files = document.files();
  return document.report(messages);
}

}  // namespace tubesight::drivers
