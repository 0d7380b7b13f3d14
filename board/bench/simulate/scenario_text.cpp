#include "board/bench/simulate/scenario_text.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <span>
#include <string_view>

#include "board/bench/simulate/scenario_fault_text.h"
#include "board/bench/simulate/scenario_keys.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::board {
namespace {

using core::kinematics::PathSegment;
using core::kinematics::SegmentKind;
using core::rendering::PlugKind;
using drivers::Scenario;
using drivers::toml_number;
using drivers::TomlWriter;

constexpr std::array<const char*, 3> kScanWords = {"even-first", "odd-first", "progressive"};
constexpr std::array<const char*, 3> kAddressWords = {"all", "even-sum", "odd-sum"};

void write_camera(TomlWriter& toml, const core::CameraSettings& camera) {
  toml.table("camera");
  toml.number("width_px", camera.width_px);
  toml.number("height_px", camera.height_px);
  toml.text("scan", kScanWords[static_cast<std::size_t>(camera.scan)]);
  toml.number("focal_length_mm", camera.focal_length_mm);
  toml.number("cell_width_mm", camera.cell_width_mm);
  toml.number("cell_height_mm", camera.cell_height_mm);
  toml.number("sensor_columns", camera.sensor_columns);
  toml.number("frame_columns", camera.frame_columns);
  toml.number("horizontal_scale", camera.horizontal_scale);
  toml.numbers("center_px", camera.center_px);
  toml.number("distortion_per_mm2", camera.distortion_per_mm2);
  toml.number("distortion2_per_mm4", camera.distortion2_per_mm4);
}

void write_tubesheet(TomlWriter& toml, const core::TubesheetSettings& sheet) {
  toml.table("tubesheet");
  toml.numbers("origin_mm", sheet.origin_mm);
  toml.numbers("row_step_mm", sheet.row_step_mm);
  toml.numbers("column_step_mm", sheet.column_step_mm);
  toml.number("bore_mm", sheet.bore_mm);
  toml.text("weld", sheet.weld == core::Weld::kFlush ? "flush" : "fillet");
  toml.numbers("rows", sheet.rows);
  toml.numbers("columns", sheet.columns);
  toml.text("addresses", kAddressWords[static_cast<std::size_t>(sheet.addresses)]);
  if (sheet.odd_row_shift != 0.0) {
    toml.number("odd_row_shift", sheet.odd_row_shift);
  }
  toml.addresses("missing", sheet.missing.view());
  toml.addresses("plugged", sheet.plugged.view());
}

void write_start(TomlWriter& toml, const core::StartSettings& start) {
  toml.table("start");
  std::string clicks;
  for (const core::StartPoint& click : start.tubes) {
    clicks += clicks.empty() ? "" : ", ";
    clicks += "{ row = " + std::to_string(click.address.row) +
              ", column = " + std::to_string(click.address.column) + ", at_px = [" +
              toml_number(click.at_px[0]) + ", " + toml_number(click.at_px[1]) + "] }";
  }
  toml.raw("tubes", "[" + clicks + "]");
  toml.numbers("window_px", start.window_px);
  toml.numbers("optimum_px", start.optimum_px);
}

void write_calibration_error(TomlWriter& toml, const Scenario& scenario) {
  const core::rendering::Scene& scene = scenario.scene;
  const core::SessionSettings& told = scenario.told;
  std::array<double, 3> position{};
  std::array<double, 3> rotation{};
  for (std::size_t i = 0; i < 3; ++i) {
    position[i] = scene.tool.position_mm[i] - told.tool.position_mm[i];
    rotation[i] = scene.tool.rotation_deg[i] - told.tool.rotation_deg[i];
  }
  const std::array<double, 2> center{scene.camera.center_px[0] - told.camera.center_px[0],
                                     scene.camera.center_px[1] - told.camera.center_px[1]};
  toml.table("calibration_error");
  toml.numbers("tool_position_mm", position);
  toml.numbers("tool_rotation_deg", rotation);
  toml.number("focal_length_mm", scene.camera.focal_length_mm - told.camera.focal_length_mm);
  toml.numbers("center_px", center);
  toml.number("horizontal_scale", scene.camera.horizontal_scale - told.camera.horizontal_scale);
  toml.number("distortion_per_mm2",
              scene.camera.distortion_per_mm2 - told.camera.distortion_per_mm2);
  toml.number("bore_mm", scene.sheet.bore_mm - told.tubesheet.bore_mm);
}

void write_told(TomlWriter& toml, const core::SessionSettings& told) {
  write_camera(toml, told.camera);
  toml.table("tool");
  toml.numbers("position_mm", told.tool.position_mm);
  toml.numbers("rotation_deg", told.tool.rotation_deg);
  write_tubesheet(toml, told.tubesheet);
  write_start(toml, told.start);
  toml.table("motion");
  toml.number("max_speed_mm_s", told.motion.max_speed_mm_s);
  toml.number("max_acceleration_mm_s2", told.motion.max_acceleration_mm_s2);
  toml.table("verification");
  toml.number("aligned_within_mm", told.verification.aligned_within_mm);
}

template <typename Struct, std::size_t N>
void write_numbers(TomlWriter& toml, const std::array<NumberKey<Struct>, N>& keys,
                   const Struct& values) {
  for (const NumberKey<Struct>& key : keys) {
    toml.number(key.key, values.*key.member);
  }
}

void write_scene(TomlWriter& toml, const Scenario& scenario) {
  const core::rendering::Scene& scene = scenario.scene;
  toml.table("sheet");
  for (const auto& [kind, key] :
       {std::pair{PlugKind::kRolled, "rolled"}, {PlugKind::kFlush, "flush"}}) {
    std::vector<core::TubeAddress> plugs;
    for (const core::rendering::Plug& plug : scene.plugs) {
      if (plug.kind == kind) {
        plugs.push_back(plug.address);
      }
    }
    toml.addresses(key, plugs);
  }
  toml.table("look");
  write_numbers(toml, kSheetLookKeys, scene.look);
  toml.table("lamp");
  toml.number("lamp_permille", scenario.light.lamp_permille);
  toml.number("pwm_hz", scenario.light.pwm_hz);
  toml.number("ring", scenario.light.ring);
  write_numbers(toml, kLampLookKeys, scene.lamp);
  toml.table("sensor");
  write_numbers(toml, kSensorLookKeys, scene.sensor);
  toml.table("guidetube");
  write_numbers(toml, kGuidetubeLookKeys, scene.guidetube);
}

void write_segment(TomlWriter& toml, const PathSegment& segment) {
  toml.entry("step");
  const bool turn = segment.kind == SegmentKind::kTurn || segment.kind == SegmentKind::kLean;
  switch (segment.kind) {
    case SegmentKind::kRest: toml.number("rest_s", segment.rest_s); return;
    case SegmentKind::kMove: toml.numbers("to_mm", segment.to_mm); break;
    case SegmentKind::kHeight: toml.number("height_mm", segment.height_mm); break;
    case SegmentKind::kDock: toml.number("dock_mm", segment.height_mm); break;
    case SegmentKind::kTurn: toml.number("heading_deg", segment.alpha_deg); break;
    case SegmentKind::kLean: toml.numbers("lean_deg", segment.lean_deg); break;
    case SegmentKind::kJump: break;
  }
  toml.text("profile",
            segment.shape == core::kinematics::SpeedShape::kTrapezoid ? "trapezoid" : "s-curve");
  toml.number(turn ? "speed_deg_s" : "speed_mm_s", segment.limits.speed);
  toml.number(turn ? "acceleration_deg_s2" : "acceleration_mm_s2", segment.limits.acceleration);
  toml.number(turn ? "jerk_deg_s3" : "jerk_mm_s3", segment.limits.jerk);
}

void write_motion(TomlWriter& toml, const Scenario& scenario) {
  const drivers::SimulatedVideo& video = scenario.video;
  toml.table("video");
  toml.number("rate_hz", static_cast<double>(video.rate_numerator) /
                             static_cast<double>(video.rate_denominator));
  toml.number("exposure_s", video.exposure_s);
  toml.number("length_s", video.length_s);
  if (video.window_margin_px >= 0) {
    toml.number("window_margin_px", video.window_margin_px);
  }
  const core::kinematics::ToolPlace& from = scenario.from;
  toml.table("path");
  toml.numbers("at_mm", std::array{from.x_mm, from.y_mm});
  toml.number("height_mm", from.height_mm);
  toml.number("heading_deg", from.alpha_deg);
  toml.numbers("lean_deg", std::array{from.beta_deg, from.gamma_deg});
  for (const PathSegment& segment : scenario.path) {
    write_segment(toml, segment);
  }
  for (const drivers::Fault& fault : scenario.faults) {
    write_fault(toml, fault);
  }
}

}  // namespace

std::string scenario_text(const Scenario& scenario, const std::string& title) {
  TomlWriter toml;
  toml.number("format", 1);
  toml.table("scenario");
  toml.text("title", title.c_str());
  toml.number("seed", static_cast<std::int64_t>(scenario.seed));
  toml.number("sheet_seed", static_cast<std::int64_t>(scenario.scene.seed));
  write_told(toml, scenario.told);
  write_calibration_error(toml, scenario);
  write_scene(toml, scenario);
  write_motion(toml, scenario);
  return toml.take();
}

}  // namespace tubesight::board
