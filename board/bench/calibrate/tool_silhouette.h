#pragma once

#include <string>
#include <string_view>

#include "core/calibration/silhouette.h"
#include "core/calibration/tool_calibration.h"
#include "core/pose/picture_pose.h"
#include "core/pose/pose_model.h"
#include "drivers/settings/silhouette_settings.h"

namespace tubesight::board {

/// Reads "DIAMETER,LENGTH" of the guidetube, mm; false, with one line in `message`, for anything
/// else.
[[nodiscard]] bool parse_guidetube(std::string_view text, core::calibration::GuidetubeShape& shape,
                                   std::string& message);

/// The silhouette as it is calibrated: computed, and moved to the edges that the docked picture
/// shows. `picture` null: nothing to measure in. A computed edge is as uncertain as the tip is.
[[nodiscard]] core::calibration::Silhouette calibrated_silhouette(
    const core::CameraSettings& settings, const core::calibration::ToolCalibration& tool,
    const core::calibration::GuidetubeShape& shape, const core::picture::AveragedPicture* picture);

/// A line for a person: which edges were found, and how far from where they were computed; `looked`
/// says whether there was a picture to look in.
[[nodiscard]] std::string silhouette_line(const core::calibration::Silhouette& silhouette,
                                          bool looked);

[[nodiscard]] drivers::SilhouetteSettings silhouette_settings(
    const core::calibration::GuidetubeShape& shape,
    const core::calibration::Silhouette& silhouette);

/// Why the guidetube can't be docked on `named` with the tool so, by what its picture shows: the
/// tube-end seen whole, or others seen through the guidetube. Empty: nothing speaks against it.
/// `shape` null: its size is not known. `height_mm` is that of the tube-ends above the tip.
[[nodiscard]] std::string why_not_docked(core::TubeAddress named,
                                         const core::pose::PictureOutcome& outcome,
                                         const core::picture::RimList& rims,
                                         const core::pose::PoseModel& model, double height_mm,
                                         const core::calibration::Silhouette* silhouette);

/// Why the guidetube can't be docked so by how wide it is seen: neither side is near its computed
/// place, and both are found farther away, a tenth nearer to or farther from each other. Empty:
/// nothing speaks against it.
[[nodiscard]] std::string why_not_as_wide(core::TubeAddress named,
                                          const core::calibration::Silhouette& computed,
                                          const core::calibration::GuidetubeShape& shape,
                                          const core::picture::AveragedPicture& picture);

}  // namespace tubesight::board
