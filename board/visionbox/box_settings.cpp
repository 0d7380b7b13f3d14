#include "board/visionbox/box_settings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string_view>
#include <vector>

#include "board/visionbox/camera_settings.h"
#include "board/visionbox/refused_keys.h"
#include "board/visionbox/settings_path.h"
#include "core/base/scalar.h"
#include "core/session/session.h"
#include "drivers/scenario/scenario_file.h"
#include "drivers/settings/read_table.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {
namespace {

using drivers::SettingsDocument;
using drivers::TableReader;

constexpr std::array<std::string_view, 11> kBoxTables = {
    "source", "control", "page",    "realtime", "link",    "record",
    "pairs",  "zones",   "journal", "lamp",     "watchdog"};
constexpr std::array<std::string_view, 4> kSourceKinds = {"replay", "simulated", "v4l2", "aravis"};
constexpr std::array<std::string_view, 4> kPlayedKeys = {"recording", "scenario", "at_end",
                                                         "script"};
constexpr std::array<std::string_view, 2> kAtEnd = {"loop", "end"};

constexpr drivers::WholeRange kPriority{0, 99};
constexpr drivers::NumberRange kDeadline{0.1, 1000.0, " ms"};
/// What a socket's address holds, less its end.
constexpr std::size_t kLongestSocketPath = 107;

constexpr drivers::NeededTables kBoxNeeds{true, true, true, false};

constexpr SourceLight light_of(SourceKind kind) {
  if (is_camera(kind)) {
    return SourceLight::kCamera;
  }
  return kind == SourceKind::kSimulated ? SourceLight::kSimulated : SourceLight::kRecorded;
}

/// A file that one kind of source plays, and the other doesn't have.
void read_file(const SettingsDocument& document, TableReader& table, std::string_view key,
               bool wanted, std::string& path) {
  if (!wanted) {
    if (table.has(key)) {
      table.complain(key, "of another kind of source, expected it left out");
    }
    table.ignore(key);
    return;
  }
  std::string name;
  if (!table.text(key, name)) {
    return;
  }
  path = from_its_folder(document, table, key, name);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    table.complain(key, "there is no file '" + path + "', expected one");
  }
}

void read_played(const SettingsDocument& document, TableReader& table, SourceSettings& source) {
  std::size_t at_end = 0;
  if (table.optional_word("at_end", kAtEnd, at_end)) {
    source.loop = at_end == 0;
  }
  table.optional_switch("script", source.script);
  const bool known = table.sound("kind");
  const bool simulated = source.kind == SourceKind::kSimulated;
  read_file(document, table, "recording", known ? !simulated : table.has("recording"),
            source.recording);
  read_file(document, table, "scenario", known ? simulated : table.has("scenario"),
            source.scenario);
}

void read_source(const SettingsDocument& document, TableReader& table, SourceSettings& source) {
  std::size_t kind = 0;
  if (!table.word("kind", kSourceKinds, kind)) {
    read_played(document, table, source);
    ignore_keys(table, kCameraKeys);
    ignore_keys(table, kV4l2Keys);
    ignore_keys(table, kAravisKeys);
    return;
  }
  constexpr const char* kOfAnother = "of another kind of source";
  source.kind = static_cast<SourceKind>(kind);
  if (source.kind == SourceKind::kV4l2) {
    read_v4l2(table, source.v4l2);
  } else {
    refuse_keys(table, kV4l2Keys, kOfAnother);
  }
  if (source.kind == SourceKind::kAravis) {
    read_aravis(table, source.aravis);
  } else {
    refuse_keys(table, kAravisKeys, kOfAnother);
  }
  if (is_camera(source.kind)) {
    refuse_keys(table, kPlayedKeys, kOfAnother);
  } else {
    read_played(document, table, source);
    refuse_keys(table, kCameraKeys, kOfAnother);
  }
}

/// What a camera has to deliver is what the session was told of it.
template <typename Settings>
void tell(const drivers::SessionFile& session, Settings& camera) {
  camera.width_px = session.settings.camera.width_px;
  camera.height_px = session.settings.camera.height_px;
  camera.scan = session.settings.camera.scan;
  camera.calibrated = {session.camera_quality.serial, session.camera_quality.model};
}

void read_control(const SettingsDocument& document, TableReader& table, std::string& socket) {
  std::string path;
  if (!table.text("socket", path)) {
    return;
  }
  socket = from_its_folder(document, table, "socket", path);
  if (path.empty() || socket.size() > kLongestSocketPath) {
    table.complain("socket", std::to_string(path.empty() ? 0 : socket.size()) +
                                 " bytes, expected a path of 1 to 107");
  }
}

void read_real_time(TableReader& table, RealTimeSettings& real_time) {
  table.optional_whole("priority", kPriority, real_time.priority);
  table.optional_switch("lock_memory", real_time.lock_memory);
  table.optional_number("deadline_ms", kDeadline, real_time.deadline_ms);
}

/// A scenario says itself what the box is told of its world.
void refuse_session(SettingsDocument& document) {
  for (const std::string_view name : drivers::kSessionTables) {
    if (const drivers::SettingsTable* const table = document.find(name)) {
      document.problems().push_back(
          {table->place, std::string(name) + ": a simulated source has the tables of its scenario, "
                                             "expected none here"});
    }
  }
}

/// Of a camera, as far as the settings say: 0 where only the camera knows. One of which only the
/// rate is known or the standard is analog and exposes a whole field.
double exposure_ms(const SourceSettings& source) {
  if (source.kind == SourceKind::kAravis) {
    return source.aravis.exposure_ms;
  }
  if (source.kind != SourceKind::kV4l2) {
    return 0.0;
  }
  if (source.v4l2.exposure_ms > 0.0) {
    return source.v4l2.exposure_ms;
  }
  if (source.v4l2.fields_per_s > 0.0) {
    return 1000.0 / source.v4l2.fields_per_s;
  }
  return source.v4l2.standard == "PAL"    ? 20.0
         : source.v4l2.standard == "NTSC" ? 1001.0 / 60.0
                                          : 0.0;
}

/// What the box keeps on its disk.
void read_kept(SettingsDocument& document, BoxSettings& box) {
  drivers::read_table(document, "record", false,
                      [&](TableReader& table) { read_record(document, table, box.record); });
  drivers::read_table(document, "pairs", false,
                      [&](TableReader& table) { read_pairs(document, table, box.pairs); });
  drivers::read_table(document, "journal", false,
                      [&](TableReader& table) { read_journal(document, table, box.journal); });
}

void read_all(SettingsDocument& document, BoxSettings& box) {
  box.source = {};
  box.control_socket.clear();
  box.page = {};
  box.real_time = {};
  box.link = {};
  box.record = {};
  box.pairs = {};
  box.zones = {};
  box.journal = {};
  box.lamp = {};
  box.watchdog = {};
  SourceLight light = SourceLight::kUnknown;
  drivers::read_table(document, "source", true, [&](TableReader& table) {
    read_source(document, table, box.source);
    light = table.sound("kind") ? light_of(box.source.kind) : light;
  });
  drivers::read_table(document, "control", false, [&](TableReader& table) {
    read_control(document, table, box.control_socket);
  });
  drivers::read_table(document, "page", false,
                      [&](TableReader& table) { read_page(document, table, box.page); });
  drivers::read_table(document, "realtime", false,
                      [&](TableReader& table) { read_real_time(table, box.real_time); });
  drivers::read_table(document, "link", false,
                      [&](TableReader& table) { read_link(table, box.link); });
  read_kept(document, box);
  drivers::read_table(document, "zones", false, [&](TableReader& table) {
    read_zones(document, table, box.link.kind != LinkKind::kNone, box.zones);
  });
  drivers::read_table(document, "watchdog", false,
                      [&](TableReader& table) { read_watchdog(table, box.watchdog); });
  std::size_t told = 0;
  drivers::read_table(document, "lamp", false, [&](TableReader& table) {
    read_lamp(table, {light, box.link.kind != LinkKind::kNone, exposure_ms(box.source)}, box.lamp);
    told = document.problems().size();
  });
  // A key that nobody knows may be one of the device, misspelt.
  box.lamp_sound = box.lamp.device_sound && document.problems().size() == told;
  if (box.source.kind == SourceKind::kSimulated) {
    refuse_session(document);
    return;
  }
  drivers::read_session(document, kBoxNeeds, box.session);
  tell(box.session, box.source.v4l2);
  tell(box.session, box.source.aravis);
  // What is not received in time is lost, so this goes before the tracking.
  const std::int32_t priority = box.real_time.priority;
  box.source.aravis.priority = priority > 0 ? std::min(priority + 1, kPriority.most) : 0;
  if (document.problems().empty() &&
      !std::make_unique<core::session::Session<core::FixedPoint>>()->configure(
          box.session.settings)) {
    document.problems().push_back(
        {{0, 0},
         "the tracking cannot compute with these settings together, expected neighbouring tubes "
         "from 2 mm apart and a picture within 60 degrees of the optical axis"});
  }
}

/// What hangs on the camera, once that is known.
void check_memory(SettingsDocument& document, const BoxSettings& box) {
  const std::string wrong = wrong_memory(box.record, box.told().camera);
  if (!wrong.empty()) {
    document.problems().push_back({document.find("record")->place, wrong});
  }
}

/// The shortest time from field to field that a source may have; 0: not known before it runs.
double least_span_s(const BoxSettings& box) {
  if (box.source.kind == SourceKind::kSimulated) {
    const auto& video = box.scenario.scenario.video;
    const bool interlaced = box.told().camera.scan != core::Scan::kProgressive;
    return static_cast<double>(video.rate_denominator) /
           static_cast<double>(video.rate_numerator * (interlaced ? 2 : 1));
  }
  if (!is_camera(box.source.kind)) {
    return 0.0;  // a recording is asked when it is opened
  }
  const bool v4l2 = box.source.kind == SourceKind::kV4l2;
  const double told = v4l2 ? box.source.v4l2.fields_per_s : box.source.aravis.fields_per_s;
  if (told > 0.0) {
    return 1.0 / told;
  }
  constexpr double kFastestStandard = 60.0;
  return box.told().camera.scan != core::Scan::kProgressive ? 1.0 / kFastestStandard : 0.0;
}

/// Limits of motion with which the box would lose its track at once are no settings.
void check_motion(SettingsDocument& document, const BoxSettings& box) {
  const double span_s = least_span_s(box);
  if (span_s <= 0.0) {
    return;
  }
  const std::string why =
      drivers::why_fields_too_seldom(box.told().motion, box.told().tubesheet, span_s);
  if (why.empty()) {
    return;
  }
  const drivers::SettingsTable* const table = document.find("motion");
  document.problems().push_back(
      {table != nullptr ? table->place : drivers::SettingsPlace{0, 0}, "motion: " + why});
}

}  // namespace

std::string_view name_of(SourceKind kind) { return kSourceKinds[static_cast<std::size_t>(kind)]; }

core::Result<void> load_box_settings(drivers::TextFiles& files, const std::string& path,
                                     BoxSettings& box, drivers::Messages& messages) {
  std::vector<std::string_view> known(kBoxTables.begin(), kBoxTables.end());
  known.insert(known.end(), drivers::kSessionTables.begin(), drivers::kSessionTables.end());
  SettingsDocument document;
  document.load(files, path, known);
  read_all(document, box);
  box.page.file = path;
  drivers::Messages of_scenario;  // its mistakes are told with the others
  core::Result<void> scenario;
  const bool simulated = box.source.kind == SourceKind::kSimulated;
  if (simulated && !box.source.scenario.empty()) {
    scenario = drivers::load_scenario(files, box.source.scenario, {}, box.scenario, of_scenario);
  }
  if (document.problems().empty() && scenario) {
    check_memory(document, box);
    check_motion(document, box);
  }
  const auto read = document.report(messages);
  std::ranges::move(of_scenario, std::back_inserter(messages));
  return read ? scenario : read;
}

core::Result<void> load_box_settings(const std::string& path, BoxSettings& box,
                                     drivers::Messages& messages) {
  drivers::DiskFiles files;
  return load_box_settings(files, path, box, messages);
}

}  // namespace tubesight::board
