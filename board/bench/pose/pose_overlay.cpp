#include "board/bench/pose/pose_overlay.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/overlay/labels.h"
#include "core/overlay/mark_scale.h"
#include "core/overlay/marks.h"
#include "core/overlay/overlay.h"
#include "core/overlay/painter.h"
#include "core/overlay/still_marks.h"
#include "core/picture/sheet_view.h"
#include "core/pose/tool_answer.h"

namespace tubesight::board {
namespace {

using core::overlay::MarkScale;
using core::overlay::Painter;
using core::overlay::PixelPoint;
using core::overlay::RimMark;

PixelPoint nearest(double u_px, double v_px) {
  return {static_cast<std::int32_t>(std::floor(u_px + 0.5)),
          static_cast<std::int32_t>(std::floor(v_px + 0.5))};
}

RimMark mark_of(const core::pose::PictureTube& tube) {
  if (tube.rim >= 0) {
    return tube.used ? RimMark::kUsed : RimMark::kRejected;
  }
  return tube.finding == core::picture::RimFinding::kBright ? RimMark::kClosed
                                                            : RimMark::kNotMeasured;
}

void draw_rim(Painter& painter, MarkScale scale, const core::picture::SheetView& view,
              const Eigen::Vector2d& center_mm, double radius_mm, RimMark mark) {
  constexpr int kCorners = 180;
  bool drawing = false;
  PixelPoint before;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const auto pixel = view.to_pixel(
        Eigen::Vector2d(center_mm + radius_mm * Eigen::Vector2d(std::cos(angle), std::sin(angle))));
    const PixelPoint here = pixel ? nearest(pixel->x(), pixel->y()) : PixelPoint{};
    if (pixel && drawing) {
      core::overlay::draw_rim_stretch(painter, scale, before, here, mark);
    }
    drawing = pixel.has_value();
    before = here;
  }
}

}  // namespace

core::RgbImageView draw_pose(const core::ImageView& still,
                             const core::pose::PictureOutcome& outcome,
                             const core::picture::RimList& rims, const core::pose::PoseModel& model,
                             bool has_tool, std::vector<std::uint8_t>& pixels) {
  pixels.assign(std::size_t{3} * static_cast<std::size_t>(still.width_px) *
                    static_cast<std::size_t>(still.height_px),
                0);
  const core::RgbImageView picture{pixels.data(), still.width_px, still.height_px,
                                   3 * still.width_px};
  core::overlay::copy_grey(still, picture);
  Painter painter(picture);
  const MarkScale scale(still.width_px);
  const core::pose::PoseEstimate& pose = outcome.pose.estimate;
  const core::picture::SheetView view(model.camera, pose.T_camera_sheet);
  for (const core::pose::PictureTube& tube : outcome.tubes) {
    const double diameter_mm = tube.rim >= 0 && tube.rim < outcome.pose.rims.size() &&
                                       outcome.pose.rims[tube.rim].diameter_mm > 0.0
                                   ? outcome.pose.rims[tube.rim].diameter_mm
                                   : model.bore_mm;
    draw_rim(painter, scale, view, model.center_mm(tube.address), diameter_mm / 2.0, mark_of(tube));
  }
  std::vector<core::overlay::Estimate> named;
  for (const core::pose::PictureTube& tube : outcome.tubes) {
    if (tube.rim >= 0) {
      for (const core::picture::RimPoint& point : rims[tube.rim].points) {
        core::overlay::draw_edge_point(painter, scale, nearest(point.u_px, point.v_px));
      }
    }
    const PixelPoint center = nearest(tube.u_px, tube.v_px);
    core::overlay::draw_rim_centre(painter, scale, center, mark_of(tube));
    named.push_back({tube.address, {center.u_px * 65'536, center.v_px * 65'536}, {}});
  }
  core::overlay::draw_addresses(painter, scale, named);
  if (has_tool) {
    const auto axis =
        view.to_pixel(core::pose::offset_from_nearest(model, pose.T_sheet_tool).axis_mm);
    if (axis) {
      core::overlay::draw_axis_point(painter, scale, nearest(axis->x(), axis->y()));
    }
  }
  return picture;
}

}  // namespace tubesight::board
