#include "drivers/settings/session_text.h"

#include <vector>

#include "drivers/settings/session_keys.h"

namespace tubesight::drivers {

void write_camera(TomlWriter& toml, const core::CameraSettings& camera) {
  toml.table("camera");
  write_keys(toml, kCameraKeys, camera);
}

void write_tool(TomlWriter& toml, const core::ToolSettings& tool) {
  toml.table("tool");
  write_keys(toml, kToolKeys, tool);
}

void write_plant(TomlWriter& toml, const core::SessionSettings& settings) {
  write_camera(toml, settings.camera);
  write_tool(toml, settings.tool);
  toml.table("tubesheet");
  write_keys(toml, kTubesheetKeys, settings.tubesheet);
  for (const AddressesKey& list : kTubesheetLists) {
    toml.addresses(list.key, (settings.tubesheet.*list.member).view());
  }
}

void write_clicks(TomlWriter& toml, const decltype(core::StartSettings::tubes)& tubes) {
  std::vector<std::string> clicks;
  for (const core::StartPoint& point : tubes) {
    TomlWriter click(toml.manner());
    write_keys(click, kAddressKeys, point.address);
    click.numbers(kClickPlaceKey, point.at_px);
    clicks.push_back(click.take_inline());
  }
  toml.inline_tables(kClicksKey, clicks);
}

void write_start(TomlWriter& toml, const core::StartSettings& start) {
  toml.table("start");
  write_clicks(toml, start.tubes);
  write_key(toml, kStartWindowKey, start);
  write_key(toml, kStartOptimumKey, start);
}

void write_limits(TomlWriter& toml, const core::SessionSettings& settings) {
  toml.table("motion");
  write_keys(toml, kMotionKeys, settings.motion);
  toml.table("edges");
  write_keys(toml, kEdgeKeys, settings.edges);
  toml.table("verification");
  write_keys(toml, kVerificationKeys, settings.verification);
}

std::string camera_text(const core::CameraSettings& camera) {
  TomlWriter toml(TomlManner::kPlain);
  write_keys(toml, kCameraKeys, camera);
  return toml.take();
}

std::string tool_text(const core::ToolSettings& tool) {
  TomlWriter toml(TomlManner::kPlain);
  write_keys(toml, kToolKeys, tool);
  return toml.take();
}

std::string session_text(const core::SessionSettings& settings) {
  TomlWriter toml(TomlManner::kPlain);
  write_plant(toml, settings);
  write_limits(toml, settings);
  if (!settings.start.tubes.empty()) {
    write_start(toml, settings.start);
  }
  return toml.take();
}

}  // namespace tubesight::drivers
