#pragma once

#include <string>

#include "core/base/settings.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::drivers {

// What the reader of a session's tables (session_tables.h) makes of these is the settings to the
// last bit; both go by the keys of session_keys.h.

/// `[camera]` alone, and `[tool]`.
void write_camera(TomlWriter& toml, const core::CameraSettings& camera);
void write_tool(TomlWriter& toml, const core::ToolSettings& tool);

/// `[camera]`, `[tool]` and `[tubesheet]`: what a plant is.
void write_plant(TomlWriter& toml, const core::SessionSettings& settings);

/// `[start]` with the clicks given.
void write_start(TomlWriter& toml, const core::StartSettings& start);
/// `tubes` of a start.
void write_clicks(TomlWriter& toml, const decltype(core::StartSettings::tubes)& tubes);

/// `[motion]`, `[edges]` and `[verification]`: what the box goes by.
void write_limits(TomlWriter& toml, const core::SessionSettings& settings);

/// The keys of `[camera]` and of `[tool]` as they stand in a session's file, a line each: the
/// canonical form that identities of calibrations are made of.
[[nodiscard]] std::string camera_text(const core::CameraSettings& camera);
[[nodiscard]] std::string tool_text(const core::ToolSettings& tool);

/// A session's file: all of these, `[start]` last and only where there are clicks.
[[nodiscard]] std::string session_text(const core::SessionSettings& settings);

}  // namespace tubesight::drivers
