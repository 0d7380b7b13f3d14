#pragma once

#include <string>

#include "core/base/settings.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::drivers {

// One function a table: each reads and checks its keys; mistakes go to the reader's problems.

/// `[camera]`: size, cells, focal length and distortion.
void read_camera(TableReader& table, core::CameraSettings& camera);

/// `[tool]`: T_camera_tool.
void read_tool(TableReader& table, core::ToolSettings& tool);

/// `[tubesheet]`: the lattice and what stands where. Replaces everything in `tubesheet`.
void read_tubesheet(TableReader& table, core::TubesheetSettings& tubesheet);

/// The tables that a start refers to; null where they are missing or wrong.
struct StartContext {
  const core::CameraSettings* camera = nullptr;
  const core::TubesheetSettings* tubesheet = nullptr;
};

/// `[start]`: clicks, window, optimum.
void read_start(TableReader& table, const StartContext& context, core::StartSettings& start);

/// `[motion]`, `[edges]`, `[verification]`: every key may be left out.
void read_motion(TableReader& table, core::MotionSettings& motion);
void read_edges(TableReader& table, core::EdgeSettings& edges);
void read_verification(TableReader& table, core::VerificationSettings& verification);

/// `[camera_quality]`, `[tool_quality]`: what a calibration wrote; of it `id` is kept.
void read_quality(TableReader& table, std::string& id);

/// `[base]`: T_sheet_base, checked only.
void read_base(TableReader& table);

}  // namespace tubesight::drivers
