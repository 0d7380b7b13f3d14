#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "board/bench/calibrate/tool_command.h"
#include "board/bench/calibrate/tool_dockings.h"
#include "board/bench/calibrate/tool_points_file.h"
#include "core/calibration/silhouette.h"
#include "core/calibration/tool_calibration.h"
#include "drivers/settings/session_settings.h"

namespace tubesight::board {

/// What a tool calibration works on, read and checked.
struct ToolInputs {
  drivers::SessionFile file;
  std::vector<DockedPictures> docks;
  std::vector<DockedPictures> checks;
  std::vector<PictureStarts> starts;  ///< of the dockings, then of the checks
  core::calibration::DockingAssumption assumption;
  Eigen::Vector2d offset_mm = Eigen::Vector2d::Zero();
  std::optional<core::calibration::GuidetubeShape> shape;
  ToolPointsFile points;
};

/// Reads settings, dockings, checks, clicks and points as the options say; `poses` is opened with
/// them where there are pictures. False after one line of each mistake on standard error.
[[nodiscard]] bool read_tool_inputs(const CalibrateToolOptions& options, ToolInputs& inputs,
                                    DockedPoses& poses);

/// "(ROW, COLUMN)"
[[nodiscard]] std::string tube_text(core::TubeAddress tube);

}  // namespace tubesight::board
