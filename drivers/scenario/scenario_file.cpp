#include "drivers/scenario/scenario_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <string_view>
#include <utility>

#include "core/base/scalar.h"
#include "core/camera/camera_setup.h"
#include "core/rendering/renderer_limits.h"
#include "core/session/session.h"
#include "drivers/files/decimal.h"
#include "drivers/scenario/scenario_clicks.h"
#include "drivers/scenario/scenario_effects.h"
#include "drivers/scenario/scenario_events.h"
#include "drivers/scenario/scenario_faults.h"
#include "drivers/scenario/scenario_keys.h"
#include "drivers/scenario/scenario_path.h"
#include "drivers/scenario/scenario_robot.h"
#include "drivers/scenario/scenario_scene.h"
#include "drivers/settings/read_table.h"
#include "drivers/settings/session_keys.h"
#include "drivers/settings/session_tables.h"
#include "drivers/settings/text_files.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::drivers {
namespace {

using core::Result;
using drivers::SettingsDocument;
using drivers::TableReader;

constexpr std::array<std::string_view, 20> kTables = {
    "scenario",  "camera",       "tool",
    "tubesheet", "start",        "motion",
    "edges",     "verification", "calibration_error",
    "sheet",     "look",         "lamp",
    "sensor",    "guidetube",    "video",
    "path",      "step",         "event",
    "fault",     "robot"};
constexpr std::string_view kExpect = "expect";

constexpr NumberRange kRate{1.0, 1000.0, " frames a second"};
constexpr drivers::WholeRange kSeed{0, std::numeric_limits<std::int32_t>::max()};
/// Round the window when it alone is drawn: rims that begin in it are measured whole.
constexpr std::int32_t kUsualMargin_px = 24;

/// Reads one scenario; what a later table needs of an earlier one is asked of `sound`.
class ScenarioReading {
 public:
  ScenarioReading(SettingsDocument& document, const ScenarioOverrides& overrides,
                  ScenarioFile& file)
      : document_(&document), overrides_(&overrides), file_(&file), to_(&file.scenario) {}

  void read() {
    read_names();
    read_told();
    read_video();
    if (camera_ && tool_ && sheet_) {
      read_scene(*document_, to_->told, to_->scene);
    }
    read_lamp(*document_, to_->light, to_->scene.lamp);
    to_->scene.seed = sheet_seed_;
    read_motion();
    read_robot(*document_, *to_);
    read_expectation();
    if (document_->problems().empty()) {
      play();
    }
  }

 private:
  void read_names();
  void read_told();
  void read_start(TableReader& table);
  void read_video();
  void read_rate(TableReader& table);
  void read_motion();
  void read_expectation();
  void play();
  void complain(drivers::SettingsPlace place, std::string text) {
    document_->problems().push_back({place, std::move(text)});
  }

  SettingsDocument* document_;
  const ScenarioOverrides* overrides_;
  ScenarioFile* file_;
  drivers::Scenario* to_;
  bool camera_ = false;
  bool tool_ = false;
  bool sheet_ = false;
  bool video_ = false;
  std::uint64_t sheet_seed_ = 1;
  std::vector<ClickWish> wishes_;
  std::vector<FaultPlaces> fault_places_;
  std::vector<EventPlace> event_places_;
};

void ScenarioReading::read_names() {
  std::int32_t seed = 1;
  std::int32_t sheet_seed = 1;
  file_->title.clear();
  drivers::read_table(*document_, "scenario", false, [&](TableReader& table) {
    table.optional_text(kTitleKey, file_->title);
    table.optional_whole(kSeedKey, kSeed, seed);
    table.optional_whole(kSheetSeedKey, kSeed, sheet_seed);
  });
  to_->seed = static_cast<std::uint64_t>(overrides_->seed >= 0 ? overrides_->seed : seed);
  sheet_seed_ = static_cast<std::uint64_t>(sheet_seed);
}

/// What the box is told: the tables of a session.
void ScenarioReading::read_told() {
  core::SessionSettings& told = to_->told;
  told.camera = {};
  told.tool = {};
  told.tubesheet.missing.clear();
  told.tubesheet.plugged.clear();
  told.start = {};
  told.motion = {};
  told.edges = {};
  told.verification = {};
  camera_ = drivers::read_table(*document_, "camera", true, [&](TableReader& table) {
    const std::size_t before = table.problems().size();
    drivers::read_camera(table, told.camera);
    constexpr std::int32_t kMost = core::rendering::kMaxPictureSide;
    for (const auto& [key, side_px] : {std::pair{"width_px", told.camera.width_px},
                                       std::pair{"height_px", told.camera.height_px}}) {
      if (table.sound(key) && side_px > kMost) {
        table.complain(key, std::to_string(side_px) + ", expected at most " +
                                std::to_string(kMost) + " in a scenario, which is drawn");
      }
    }
    if (table.problems().size() == before &&
        !core::camera::make_camera_model<core::FixedPoint>(told.camera)) {
      table.complain("focal_length_mm",
                     number_text(told.camera.focal_length_mm) +
                         ", expected a picture within 60 degrees of the optical axis, and 32 to "
                         "16000 px to the focal length");
    }
  });
  tool_ = drivers::read_table(*document_, "tool", true,
                              [&](TableReader& table) { drivers::read_tool(table, told.tool); });
  sheet_ = drivers::read_table(*document_, "tubesheet", true, [&](TableReader& table) {
    drivers::read_tubesheet(table, told.tubesheet);
  });
  drivers::read_table(*document_, "start", true, [&](TableReader& table) { read_start(table); });
  drivers::read_table(*document_, "motion", false,
                      [&](TableReader& table) { drivers::read_motion(table, told.motion); });
  drivers::read_table(*document_, "edges", false,
                      [&](TableReader& table) { drivers::read_edges(table, told.edges); });
  drivers::read_table(*document_, "verification", false, [&](TableReader& table) {
    drivers::read_verification(table, told.verification);
  });
}

void ScenarioReading::read_start(TableReader& table) {
  core::SessionSettings& told = to_->told;
  const drivers::StartContext context{camera_ ? &told.camera : nullptr,
                                      sheet_ ? &told.tubesheet : nullptr};
  drivers::read_start_window(table, context, told.start);
  if (table.has(drivers::kClicksKey)) {
    drivers::read_clicks(table, context, 3, told.start);
    for (const std::string_view key : {kClickOnKey, kOffCenterKey}) {
      if (table.has(key)) {
        table.complain(key, "tubes are given as well, expected one of them");
      }
      table.ignore(key);
    }
    return;
  }
  table.ignore(drivers::kClicksKey);
  ClickWish wish;
  if (sheet_) {
    read_click_wish(table, told.tubesheet, wish);
  } else {
    table.ignore(kClickOnKey);
    table.ignore(kOffCenterKey);
  }
  wishes_.push_back(wish);
}

void ScenarioReading::read_video() {
  drivers::SimulatedVideo& video = to_->video;
  video = {};
  bool sound = true;
  drivers::read_table(*document_, "video", false, [&](TableReader& table) {
    const std::size_t before = table.problems().size();
    read_rate(table);
    drivers::read_keys(table, kVideoKeys, video);
    const double field_s = static_cast<double>(video.rate_denominator) /
                           static_cast<double>(video.rate_numerator) /
                           (to_->told.camera.scan == core::Scan::kProgressive ? 1.0 : 2.0);
    if (video.exposure_s > field_s) {
      table.complain("exposure_s", "longer than a field of " +
                                       std::to_string(std::lround(field_s * 1e6)) +
                                       " us, expected at most that");
    }
    sound = table.problems().size() == before;
  });
  video_ = sound;
  if (overrides_->window_only && video.window_margin_px < 0) {
    video.window_margin_px = kUsualMargin_px;
  }
}

void ScenarioReading::read_rate(TableReader& table) {
  double rate_hz = 30.0;
  if (!table.optional_number(kRateKey, kRate, rate_hz)) {
    return;
  }
  // To a millionth: 29.97 is 2997/100.
  constexpr std::int64_t kMillion = 1'000'000;
  const auto millionths = static_cast<std::int64_t>(std::llround(rate_hz * 1e6));
  const std::int64_t common = std::gcd(millionths, kMillion);
  to_->video.rate_numerator = millionths / common;
  to_->video.rate_denominator = kMillion / common;
}

/// The path, and what is told and goes wrong on it.
void ScenarioReading::read_motion() {
  double length_s = to_->video.length_s;
  to_->path.clear();
  to_->events.clear();
  event_places_.clear();
  if (sheet_) {
    PathReader path(to_->told.tubesheet, to_->seed, *to_);
    const bool sound = path.read(*document_);
    event_places_ = path.claims();
    if (!sound) {
      length_s = 0.0;
    } else if (length_s <= 0.0) {
      length_s = path.path().duration_s();
    }
    if (sound && (length_s <= 0.0 || length_s > kLongest_s)) {
      complain(document_->find("path")->place,
               length_s > 0.0 ? "path: the recording would be longer than 86400 s, expected less"
                              : "path: it takes no time, expected a [[step]] or video.length_s");
      length_s = 0.0;
    }
  }
  const FaultContext context{length_s, to_->told.camera.scan != core::Scan::kProgressive,
                             &to_->told.tubesheet};
  read_faults(*document_, context, to_->faults, fault_places_);
  read_events(*document_, to_->told, length_s, {&to_->events, &event_places_, &wishes_});
}

void ScenarioReading::read_expectation() {
  Expectation& expect = file_->expect;
  expect = {};
  drivers::read_table(*document_, kExpect, false, [&](TableReader& table) {
    drivers::read_keys(table, kExpectationKeys, expect);
  });
}

/// What only the whole can tell: whether it can be drawn, and where the operator would click.
void ScenarioReading::play() {
  if (const std::string wrong = why_robot_cannot(*to_); !wrong.empty()) {
    complain(document_->find("robot")->place, wrong);
    return;
  }
  const auto world = std::make_unique<drivers::SimulatedWorld>();
  if (!world->configure(*to_)) {
    complain({},
             "scenario: camera, sheet and looks cannot be drawn together, expected a picture of "
             "at most " +
                 std::to_string(core::rendering::kMaxPictureSide) +
                 " pixels a side and tube-ends before the camera");
    return;
  }
  if (!std::make_unique<core::session::Session<core::FixedPoint>>()->configure(to_->told)) {
    complain({},
             "scenario: the tracking cannot compute with these settings together, expected "
             "neighbouring tubes from 2 mm apart and a picture within 60 degrees of the "
             "optical axis");
    return;
  }
  for (const ClickWish& wish : wishes_) {
    auto* clicks = &to_->told.start.tubes;
    if (wish.event >= 0) {
      auto& event = to_->events[static_cast<std::size_t>(wish.event)].event;
      clicks = &core::content_if<core::Start>(event)->tubes;
    }
    const std::string wrong = make_clicks(wish, *to_, *world, *clicks);
    if (!wrong.empty()) {
      complain(wish.place, wish.name + ": " + wrong);
    }
  }
  check_faults(*to_, *world, fault_places_, document_->problems());
  check_events(*to_, *world, event_places_, document_->problems());
  std::stable_sort(to_->events.begin(), to_->events.end(),
                   [](const drivers::ScenarioEvent& a, const drivers::ScenarioEvent& b) {
                     return a.at_s < b.at_s;
                   });
}

}  // namespace

Result<void> load_scenario(drivers::TextFiles& files, const std::string& path,
                           const ScenarioOverrides& overrides, ScenarioFile& file,
                           drivers::Messages& messages) {
  std::array<std::string_view, kTables.size() + 1> known{};
  std::copy(kTables.begin(), kTables.end(), known.begin());
  known.back() = kExpect;
  SettingsDocument document;
  document.load(files, path, known);
  ScenarioReading(document, overrides, file).read();
  file.files = document.files();
  return document.report(messages);
}

Result<void> load_scenario(const std::string& path, const ScenarioOverrides& overrides,
                           ScenarioFile& file, drivers::Messages& messages) {
  drivers::DiskFiles files;
  return load_scenario(files, path, overrides, file, messages);
}

}  // namespace tubesight::drivers
