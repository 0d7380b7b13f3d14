#pragma once

#include <cstdint>
#include <vector>

#include "core/base/image_view.h"
#include "core/pose/picture_pose.h"
#include "core/pose/pose_model.h"

namespace tubesight::board {

/// Draws what a pose was made from: each fitted rim as the pose projects it, through the lens
/// (green used, orange measured and rejected, grey not measured, magenta no dark inside), the edge
/// points (white), the images of the tubes' centres, and the place where the guidetube's axis meets
/// the sheet (blue). `pixels` is replaced; the view is valid as long as it is.
[[nodiscard]] core::RgbImageView draw_pose(const core::ImageView& still,
                                           const core::pose::PictureOutcome& outcome,
                                           const core::picture::RimList& rims,
                                           const core::pose::PoseModel& model, bool has_tool,
                                           std::vector<std::uint8_t>& pixels);

}  // namespace tubesight::board
