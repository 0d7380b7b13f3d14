#pragma once

#include <array>
#include <cstddef>
#include <optional>
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

/// `[start]`: clicks, of which there must be `least`, 3 or 0; window, optimum.
void read_start(TableReader& table, const StartContext& context, std::size_t least,
                core::StartSettings& start);
/// Its two halves: `tubes`; `window_px` and `optimum_px`.
void read_clicks(TableReader& table, const StartContext& context, std::size_t least,
                 core::StartSettings& start);
void read_start_window(TableReader& table, const StartContext& context, core::StartSettings& start);

/// `heading_deg` of `[start]`, which may be left out.
void read_heading(TableReader& table, std::optional<double>& heading_deg);

/// `[motion]`, `[edges]`, `[verification]`: every key may be left out.
void read_motion(TableReader& table, core::MotionSettings& motion);
void read_edges(TableReader& table, core::EdgeSettings& edges);
void read_verification(TableReader& table, core::VerificationSettings& verification);

/// What a calibration says of itself: `[camera_quality]`, `[tool_quality]` or
/// `[base_quality]`.
struct CalibrationQuality {
  std::string id;          ///< empty when there is no table
  std::string serial;      ///< of the camera that was calibrated; empty: it is not said
  std::string model;       ///< the same
  bool has_sigma = false;  ///< `sigma` is there as six numbers, none below zero
  /// One standard deviation each: of focal_length_mm, horizontal_scale, center_px (2),
  /// distortion_per_mm2, distortion2_per_mm4; or of position_mm (3), rotation_deg (3).
  std::array<double, 6> sigma{};
  /// Row by row; the identity unless `correlation` is there as six lists of six numbers.
  std::array<double, 36> correlation{};
  /// Of a tool whose docking told the camera's EFL, too: of its six values with that; else 0.
  std::array<double, 6> focal_length_correlation{};
};

/// Which camera it was: `serial` and `model`, where they stand.
void read_camera_device(TableReader& table, CalibrationQuality& quality);

/// `[camera_quality]`, `[tool_quality]`, `[base_quality]`: `id` must be there, `serial` and
/// `model` may be; the rest is taken where it has the form above and else left out.
void read_quality(TableReader& table, CalibrationQuality& quality);

/// `[base]`: T_sheet_base, checked only.
void read_base(TableReader& table);

}  // namespace tubesight::drivers
