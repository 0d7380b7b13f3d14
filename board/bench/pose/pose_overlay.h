#pragma once

#include <cstdint>
#include <vector>

#include "core/base/image_view.h"
#include "core/pose/picture_pose.h"
#include "core/pose/pose_model.h"

namespace tubesight::board {

/// Draws what a pose was made from: each tube-end's rim as the pose projects it, through the lens,
/// and a mark at the image of its centre (core/overlay/still_marks.h), the edge points (white), the
/// addresses where there is room, and the place where the guidetube's axis meets the sheet (pale
/// ring). `pixels` is replaced; the view is valid as long as it is.
[[nodiscard]] core::RgbImageView draw_pose(const core::ImageView& still,
                                           const core::pose::PictureOutcome& outcome,
                                           const core::picture::RimList& rims,
                                           const core::pose::PoseModel& model, bool has_tool,
                                           std::vector<std::uint8_t>& pixels);

}  // namespace tubesight::board
