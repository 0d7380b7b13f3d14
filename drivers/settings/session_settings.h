#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/settings.h"
#include "drivers/files/messages.h"
#include "drivers/settings/session_tables.h"
#include "drivers/settings/settings_document.h"
#include "drivers/settings/silhouette_settings.h"
#include "drivers/settings/text_files.h"

namespace tubesight::drivers {

/// Which tables of a session a command cannot do without; others are read where they stand.
struct NeededTables {
  bool camera = false;
  bool tool = false;
  bool tubesheet = false;
  bool start = false;
  /// Fewer clicks than three will do, or none: the lattice is found cold, or nothing is named yet.
  bool few_clicks = false;
};

/// `replay`: all four.
inline constexpr NeededTables kReplayNeeds{true, true, true, true, true};
/// `pose`: the tool only for the tool's cells, the start may come from the command line.
inline constexpr NeededTables kPoseNeeds{true, false, true, false, true};
/// `calibrate tool`: the tool is what it finds.
inline constexpr NeededTables kCalibrateToolNeeds{true, false, true, false};

/// A session file as read. About 260 KB: static or heap, never on a stack.
struct SessionFile {
  std::vector<std::string> files;  ///< that it was read from, its own first
  core::SessionSettings settings;
  bool has_tool = false;
  bool has_start = false;  ///< without it the window is the whole picture
  /// `heading_deg` of the start: the tool's on the sheet, good to 20 degrees.
  std::optional<double> heading_deg;
  CalibrationQuality camera_quality;
  CalibrationQuality tool_quality;
  CalibrationQuality base_quality;
  SilhouetteSettings silhouette;  ///< of the guidetube; kept for whoever watches it
};

/// The tables of a session.
inline constexpr std::array<std::string_view, 12> kSessionTables = {
    "camera", "camera_quality", "tool",         "tool_quality", "tubesheet",    "start",
    "motion", "edges",          "verification", "base",         "base_quality", "silhouette"};

/// Reads the session's tables of a document that may have others, too; mistakes go to its problems.
/// Everything in `session` is replaced.
void read_session(SettingsDocument& document, NeededTables needed, SessionFile& session);

/// Reads a session's settings from `path` and the files that it includes.
///
/// Everything in `session` is replaced; after an error it is not to be used. Errors:
/// kInvalidArgument, with one message for each mistake in all the files ("file:line: key: what,
/// expected ..."), in the order of files and lines.
[[nodiscard]] core::Result<void> load_session_settings(const std::string& path, NeededTables needed,
                                                       SessionFile& session, Messages& messages);

/// The same with files from elsewhere.
[[nodiscard]] core::Result<void> load_session_settings(TextFiles& files, const std::string& path,
                                                       NeededTables needed, SessionFile& session,
                                                       Messages& messages);

}  // namespace tubesight::drivers
