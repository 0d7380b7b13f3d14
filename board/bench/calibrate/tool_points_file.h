#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/settings.h"
#include "core/calibration/tool_points.h"

namespace tubesight::board {

/// A points file as it stands: `x_mm,y_mm,z_mm,u_px,v_px`, a row a point of a target on the
/// guidetube, in the tool frame, and where the picture shows it.
struct ToolPointsFile {
  core::calibration::ToolPointList points;
  std::vector<std::int64_t> lines;  ///< of the points in the file
};

/// Reads it. False, with one line in `message`, for a bad row, a place outside the picture, or too
/// many points.
[[nodiscard]] bool read_tool_points(const std::string& path, const core::CameraSettings& camera,
                                    ToolPointsFile& file, std::string& message);

/// Why points give no tool, in one line without the file's name.
[[nodiscard]] std::string_view explain(core::calibration::ToolPointsRefusal refusal);

/// What a person reads of the points: how well they fit, and those left out by their lines.
[[nodiscard]] std::string points_text(const ToolPointsFile& file,
                                      const core::calibration::ToolPointsOutcome& outcome);

}  // namespace tubesight::board
