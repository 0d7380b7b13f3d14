#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "board/bench/calibrate/tool_focal.h"
#include "core/base/settings.h"
#include "core/calibration/silhouette.h"
#include "core/calibration/tool_calibration.h"

namespace tubesight::board {

/// All that was found of a tool.
struct ToolReport {
  core::calibration::ToolCalibration tool;
  core::calibration::DockingAssumption assumption;
  std::int32_t dockings = 0;  ///< 0: from points
  std::int32_t points = 0;
  core::CameraSettings camera;  ///< with the EFL found
  std::optional<FreedFocal> focal;
  double focal_before_mm = 0.0;
  /// Of the tool's six values with the EFL found.
  core::math::Vector6d focal_correlation = core::math::Vector6d::Zero();
  std::optional<core::calibration::GuidetubeShape> shape;
  core::calibration::Silhouette silhouette;  ///< with `shape`
};

/// Tip and axis with their deviations, the EFL and the silhouette: lines for a person.
[[nodiscard]] std::string tool_report_text(const ToolReport& report);

/// The settings file: `[tool]` and `[tool_quality]`, with a freed EFL `[camera]` and
/// `[camera_quality]` before them, `[silhouette]` where there is one.
[[nodiscard]] std::string tool_settings_text(const ToolReport& report,
                                             const drivers::CalibrationQuality& device);

}  // namespace tubesight::board
