#include "board/bench/pose/pose_overlay.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/overlay/overlay.h"
#include "core/overlay/painter.h"
#include "core/overlay/palette.h"
#include "core/picture/sheet_view.h"
#include "core/pose/tool_answer.h"

namespace tubesight::board {
namespace {

using core::overlay::Painter;
using core::overlay::PixelPoint;
using core::overlay::Rgb;
namespace palette = core::overlay::palette;

PixelPoint nearest(double u_px, double v_px) {
  return {static_cast<std::int32_t>(std::floor(u_px + 0.5)),
          static_cast<std::int32_t>(std::floor(v_px + 0.5))};
}

Rgb colour_of(const core::pose::PictureTube& tube) {
  if (tube.rim >= 0) {
    return tube.used ? palette::kUsed : palette::kRejected;
  }
  return tube.finding == core::picture::RimFinding::kBright ? palette::kPlug
                                                            : palette::kEstimateAbsent;
}

void draw_circle(Painter& painter, const core::picture::SheetView& view,
                 const Eigen::Vector2d& center_mm, double radius_mm, Rgb colour) {
  constexpr int kCorners = 180;
  bool drawing = false;
  PixelPoint before;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const auto pixel = view.to_pixel(
        Eigen::Vector2d(center_mm + radius_mm * Eigen::Vector2d(std::cos(angle), std::sin(angle))));
    const PixelPoint here = pixel ? nearest(pixel->x(), pixel->y()) : PixelPoint{};
    if (pixel && drawing) {
      painter.line(before, here, 1, colour);
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
  const core::pose::PoseEstimate& pose = outcome.pose.estimate;
  const core::picture::SheetView view(model.camera, pose.T_camera_sheet);
  for (const core::pose::PictureTube& tube : outcome.tubes) {
    const double diameter_mm = tube.rim >= 0 && tube.rim < outcome.pose.rims.size() &&
                                       outcome.pose.rims[tube.rim].diameter_mm > 0.0
                                   ? outcome.pose.rims[tube.rim].diameter_mm
                                   : model.bore_mm;
    draw_circle(painter, view, model.center_mm(tube.address), diameter_mm / 2.0, colour_of(tube));
  }
  for (const core::pose::PictureTube& tube : outcome.tubes) {
    if (tube.rim >= 0) {
      for (const core::picture::RimPoint& point : rims[tube.rim].points) {
        painter.pixel(nearest(point.u_px, point.v_px), palette::kWhite);
      }
      painter.cross_hair(nearest(tube.u_px, tube.v_px), 0, 3, 1, colour_of(tube));
    } else {
      painter.diagonal_cross(nearest(tube.u_px, tube.v_px), 3, 1, colour_of(tube));
    }
  }
  if (has_tool) {
    const auto axis =
        view.to_pixel(core::pose::offset_from_nearest(model, pose.T_sheet_tool).axis_mm);
    if (axis) {
      painter.cross_hair(nearest(axis->x(), axis->y()), 2, 9, 2, palette::kTool);
    }
  }
  return picture;
}

}  // namespace tubesight::board
