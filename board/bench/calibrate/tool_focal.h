#pragma once

#include <span>
#include <string>
#include <vector>

#include "board/bench/calibrate/tool_dockings.h"
#include "board/bench/output/exit_status.h"
#include "board/bench/output/progress_line.h"
#include "core/calibration/camera_calibration.h"
#include "core/calibration/docking_focal.h"
#include "drivers/settings/session_tables.h"

namespace tubesight::board {

/// The camera with its EFL freed at docking.
struct FreedFocal {
  ExitStatus status = ExitStatus::kDone;
  std::string message;  ///< why not kDone, without the session's name unless a picture is to blame
  core::calibration::DockingFocal focal;
  core::math::Matrix6d covariance = core::math::Matrix6d::Zero();  ///< of the camera's parameters
  core::calibration::MapUncertainty map;                           ///< but for a turn of the camera
  double tip_mm = 0.0;  ///< as of tip_by_freed(); 0: not told yet
};

/// Finds the EFL that all dockings agree on, from the type's on, within a tenth of it. `poses` goes
/// on with it. Refused where the map from pixels to rays stays unknown to 1 px.
///
/// `type` is the type's quality, as far as the session tells it: its deviations but the EFL's
/// count.
[[nodiscard]] FreedFocal free_focal(DockedPoses& poses, std::span<const DockedPictures> dockings,
                                    std::span<const PictureStarts> starts,
                                    const drivers::CalibrationQuality& type,
                                    ProgressLine& progress);

/// How far below the sheet tip_by_freed() looks: as far as a tool works.
inline constexpr double kFreedGap_mm = 90.0;

/// How well the tip's place across the sheet is known there by a camera so calibrated, one standard
/// deviation along the worse axis, where the tool was docked with it; what such a camera is judged
/// by. Negative: too few tube-ends are in the picture there to tell.
[[nodiscard]] double tip_by_freed(
    const FreedFocal& freed, const core::CameraSettings& camera,
    const core::Transform<core::frames::Camera, core::frames::Tool>& T,
    const core::TubesheetSettings& sheet);

/// What a camera so calibrated may be used for.
inline constexpr std::string_view kFreedFocalUse =
    "tracking and position correction only: EFL freed at docking, the rest is its type's";

}  // namespace tubesight::board
