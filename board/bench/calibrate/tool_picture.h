#pragma once

#include <string>
#include <vector>

#include "board/bench/calibrate/tool_text.h"
#include "core/base/image_view.h"
#include "core/pose/picture_pose.h"
#include "core/pose/pose_model.h"

namespace tubesight::board {

/// A residual of the calibration in the picture.
struct ToolMiss {
  Eigen::Vector2d at_px;   ///< where the calibration puts it
  Eigen::Vector2d off_px;  ///< from there to where it is seen
  bool used = true;
};

/// What is drawn of a tool.
struct ToolPicture {
  core::ImageView still;  ///< docked; of no size: nothing was looked at, the ground is black
  const core::pose::PictureOutcome* outcome = nullptr;  ///< the docking's pose; null: from points
  const core::picture::RimList* rims = nullptr;
  const core::pose::PoseModel* model = nullptr;
  std::vector<ToolMiss> misses;
};

/// The misses of the tube-ends' centres in a docked picture.
[[nodiscard]] std::vector<ToolMiss> tube_misses(const core::pose::PictureOutcome& outcome,
                                                const core::pose::PoseModel& model);

/// Draws, twice as large as a small picture: the tube-ends found (green used, orange rejected),
/// misses as arrows 200 times as long (of points 20 times), the tip and the axis down from it
/// (blue), and the silhouette (white where the picture showed the edge, grey dashes where it is
/// computed), with words below. False, with one line in `message`, when it cannot be written.
[[nodiscard]] bool write_tool_picture(const std::string& path, const ToolReport& report,
                                      const ToolPicture& picture, std::string& message);

}  // namespace tubesight::board
