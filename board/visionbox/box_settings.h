#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "board/visionbox/journal_settings.h"
#include "board/visionbox/lamp_settings.h"
#include "board/visionbox/link_settings.h"
#include "board/visionbox/page_settings.h"
#include "board/visionbox/pairs_settings.h"
#include "board/visionbox/real_time.h"
#include "board/visionbox/record_settings.h"
#include "board/visionbox/watchdog_settings.h"
#include "board/visionbox/zones_settings.h"
#include "core/base/result.h"
#include "drivers/aravis/aravis_settings.h"
#include "drivers/files/messages.h"
#include "drivers/scenario/scenario_file.h"
#include "drivers/settings/session_settings.h"
#include "drivers/settings/text_files.h"
#include "drivers/v4l2/v4l2_settings.h"

namespace tubesight::board {

/// What the box watches; the order of the words of `kind`.
enum class SourceKind : std::uint8_t { kReplay, kSimulated, kV4l2, kAravis };

/// The word of a kind.
[[nodiscard]] std::string_view name_of(SourceKind kind);

/// Whether it is a camera, and not something that is played.
[[nodiscard]] constexpr bool is_camera(SourceKind kind) {
  return kind == SourceKind::kV4l2 || kind == SourceKind::kAravis;
}

/// The table `[source]`. Paths are as they can be opened: relative ones were resolved from the
/// folder of the file that names them.
struct SourceSettings {
  SourceKind kind = SourceKind::kReplay;
  std::string recording;           ///< of a replay
  std::string scenario;            ///< of a simulation
  bool loop = true;                ///< begin anew at the end
  bool script = false;             ///< play the robot and the operator that are written down, too
  bool in_real_time = true;        ///< of what is played; not in the file, for tests
  drivers::V4l2Settings v4l2;      ///< of a camera, with what the session says of it
  drivers::AravisSettings aravis;  ///< the same
};

/// Everything that the box is started with. Some 900 KB: static or heap, never on a stack.
struct BoxSettings {
  SourceSettings source;
  std::string control_socket;  ///< empty: nobody can ask
  RealTimeSettings real_time;
  LinkSettings link;
  RecordSettings record;
  PageSettings page;
  PairsSettings pairs;
  JournalSettings journal;
  ZonesSettings zones;
  LampSettings lamp;
  WatchdogSettings watchdog;
  bool lamp_sound = false;  ///< which lamp it is, is known: it can be made dark
  drivers::SessionFile session;
  drivers::ScenarioFile scenario;  ///< of a simulation, which has the session in it

  /// The session's settings, wherever they come from.
  [[nodiscard]] const core::SessionSettings& told() const {
    return source.kind == SourceKind::kSimulated ? scenario.scenario.told : session.settings;
  }
};

/// Reads the box's settings from `path` and the files that it includes, the session's tables among
/// them or a scenario beside, and checks them whole; devices are not opened.
///
/// Everything in `box` is replaced; after an error nothing but `lamp_sound`, and the lamp's device
/// where that is true, is to be used. Errors: kInvalidArgument, with one message for each mistake
/// in all the files ("file:line: key: what, expected ...").
[[nodiscard]] core::Result<void> load_box_settings(drivers::TextFiles& files,
                                                   const std::string& path, BoxSettings& box,
                                                   drivers::Messages& messages);

/// The same from the file system.
[[nodiscard]] core::Result<void> load_box_settings(const std::string& path, BoxSettings& box,
                                                   drivers::Messages& messages);

}  // namespace tubesight::board
