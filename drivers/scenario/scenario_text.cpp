#include "drivers/scenario/scenario_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/base/assert.h"
#include "core/tubesheet/sheet_places.h"
#include "drivers/scenario/scenario_events.h"
#include "drivers/scenario/scenario_faults.h"
#include "drivers/scenario/scenario_keys.h"
#include "drivers/settings/session_keys.h"
#include "drivers/settings/session_text.h"

namespace tubesight::drivers {
namespace {

using core::kinematics::PathSegment;
using core::kinematics::SegmentKind;
using drivers::Scenario;
using drivers::TomlWriter;
using drivers::write_key;
using drivers::write_keys;

void write_calibration_error(TomlWriter& toml, const Scenario& scenario) {
  const core::rendering::Scene& scene = scenario.scene;
  const core::SessionSettings& told = scenario.told;
  CalibrationError error;
  for (std::size_t i = 0; i < 3; ++i) {
    error.tool_position_mm[i] = scene.tool.position_mm[i] - told.tool.position_mm[i];
    error.tool_rotation_deg[i] = scene.tool.rotation_deg[i] - told.tool.rotation_deg[i];
  }
  error.focal_length_mm = scene.camera.focal_length_mm - told.camera.focal_length_mm;
  error.center_px = {scene.camera.center_px[0] - told.camera.center_px[0],
                     scene.camera.center_px[1] - told.camera.center_px[1]};
  error.horizontal_scale = scene.camera.horizontal_scale - told.camera.horizontal_scale;
  error.distortion_per_mm2 = scene.camera.distortion_per_mm2 - told.camera.distortion_per_mm2;
  error.pitch_share = core::tubesheet::stretch_of(scene.sheet, told.tubesheet) - 1.0;
  error.bore_mm = scene.sheet.bore_mm - told.tubesheet.bore_mm;
  toml.table("calibration_error");
  write_keys(toml, kCalibrationErrorKeys, error);
}

/// What stands on the sheet beside what the box is told.
void write_sheet(TomlWriter& toml, const Scenario& scenario) {
  const core::rendering::Scene& scene = scenario.scene;
  toml.table("sheet");
  for (const PlugsKey& key : kPlugsKeys) {
    std::vector<core::TubeAddress> plugs;
    for (const core::rendering::Plug& plug : scene.plugs) {
      if (plug.kind == key.kind) {
        plugs.push_back(plug.address);
      }
    }
    toml.addresses(key.key, plugs);
  }
  const auto missing = scenario.told.tubesheet.missing.view();
  std::vector<core::TubeAddress> told(missing.begin(), missing.end());
  std::sort(told.begin(), told.end());
  std::vector<core::TubeAddress> voids;
  for (const core::TubeAddress address : scene.sheet.missing) {
    if (!std::binary_search(told.begin(), told.end(), address)) {
      voids.push_back(address);
    }
  }
  toml.addresses(kVoidsKey, voids);
  std::vector<std::string> displaced;
  for (const core::rendering::DisplacedTube& tube : scene.displaced) {
    TomlWriter entry(toml.manner());
    write_keys(entry, drivers::kAddressKeys, tube.address);
    write_keys(entry, kDisplacementKeys, tube);
    displaced.push_back(entry.take_inline());
  }
  if (!displaced.empty()) {
    toml.inline_tables(kDisplacedKey, displaced);
  }
}

void write_looks(TomlWriter& toml, const Scenario& scenario) {
  const core::rendering::Scene& scene = scenario.scene;
  toml.table("look");
  write_keys(toml, kSheetLookKeys, scene.look);
  toml.table("lamp");
  write_keys(toml, kLightKeys, scenario.light);
  write_keys(toml, kLampLookKeys, scene.lamp);
  toml.table("sensor");
  write_keys(toml, kSensorLookKeys, scene.sensor);
  toml.table("guidetube");
  write_keys(toml, kGuidetubeLookKeys, scene.guidetube);
}

void write_segment(TomlWriter& toml, const PathSegment& segment) {
  toml.entry("step");
  switch (segment.kind) {
    case SegmentKind::kRest: write_key(toml, kStepRest, segment); return;
    case SegmentKind::kMove: write_key(toml, kStepTo, segment); break;
    case SegmentKind::kHeight: write_key(toml, kStepHeight, segment); break;
    case SegmentKind::kDock: write_key(toml, kStepDock, segment); break;
    case SegmentKind::kTurn: write_key(toml, kStepHeading, segment); break;
    case SegmentKind::kLean: write_key(toml, kStepLean, segment); break;
    case SegmentKind::kJump: TUBESIGHT_ASSERT(false); break;
  }
  toml.text(kProfileKey, kProfileWords[static_cast<std::size_t>(segment.shape)]);
  const bool turn = segment.kind == SegmentKind::kTurn || segment.kind == SegmentKind::kLean;
  write_keys(toml, turn ? kTurnKeys : kMoveKeys, segment.limits);
}

void write_motion(TomlWriter& toml, const Scenario& scenario) {
  const drivers::SimulatedVideo& video = scenario.video;
  toml.table("video");
  toml.number(kRateKey, static_cast<double>(video.rate_numerator) /
                            static_cast<double>(video.rate_denominator));
  write_keys(toml, kVideoKeys, video);
  const core::kinematics::ToolPlace& from = scenario.from;
  toml.table("path");
  toml.numbers(kPlaceKey, std::array{from.x_mm, from.y_mm});
  write_keys(toml, kFromKeys, from);
  toml.numbers(kLeanKey, std::array{from.beta_deg, from.gamma_deg});
  for (const PathSegment& segment : scenario.path) {
    write_segment(toml, segment);
  }
  for (const drivers::Fault& fault : scenario.faults) {
    write_fault(toml, fault);
  }
  for (const drivers::ScenarioEvent& event : scenario.events) {
    write_event(toml, event);
  }
}

}  // namespace

std::string scenario_text(const Scenario& scenario, const std::string& title,
                          const Expectation* expect) {
  TUBESIGHT_ASSERT(!scenario.robot);
  TomlWriter toml;
  toml.whole("format", 1);
  toml.table("scenario");
  toml.text(kTitleKey, title);
  toml.whole(kSeedKey, static_cast<std::int64_t>(scenario.seed));
  toml.whole(kSheetSeedKey, static_cast<std::int64_t>(scenario.scene.seed));
  drivers::write_plant(toml, scenario.told);
  drivers::write_start(toml, scenario.told.start);
  drivers::write_limits(toml, scenario.told);
  write_calibration_error(toml, scenario);
  write_sheet(toml, scenario);
  write_looks(toml, scenario);
  write_motion(toml, scenario);
  if (expect != nullptr) {
    toml.table("expect");
    write_keys(toml, kExpectationKeys, *expect);
  }
  return toml.take();
}

}  // namespace tubesight::drivers
