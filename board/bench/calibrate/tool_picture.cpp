#include "board/bench/calibrate/tool_picture.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "board/bench/pose/pose_overlay.h"
#include "core/camera/camera_setup.h"
#include "core/math/covariance.h"
#include "core/overlay/painter.h"
#include "core/overlay/palette.h"
#include "core/picture/sheet_view.h"
#include "drivers/files/decimal.h"
#include "drivers/files/png_writer.h"

namespace tubesight::board {
namespace {

using core::overlay::Painter;
using core::overlay::PixelPoint;
namespace palette = core::overlay::palette;

constexpr std::int32_t kMostZoomed_px = 1000;  // wider pictures are drawn as they are
constexpr std::int32_t kLine_px = 14;
constexpr double kTubeScale = 200.0;  // tube-ends miss by hundredths of a pixel
constexpr double kPointScale = 20.0;

std::int32_t zoom_of(const core::CameraSettings& camera) {
  return camera.width_px <= kMostZoomed_px ? 2 : 1;
}

/// A place of the camera's picture in the one drawn, where its pixels are blocks.
PixelPoint zoomed(const Eigen::Vector2d& pixel, std::int32_t zoom) {
  return {static_cast<std::int32_t>(std::lround(zoom * pixel.x() + 0.5 * (zoom - 1))),
          static_cast<std::int32_t>(std::lround(zoom * pixel.y() + 0.5 * (zoom - 1)))};
}

/// The docked picture with its tube-ends, each pixel as a block.
void draw_ground(const ToolPicture& picture, const core::RgbImageView& view, std::int32_t zoom) {
  if (picture.outcome == nullptr || picture.still.width_px == 0) {
    return;
  }
  std::vector<std::uint8_t> pixels;
  const core::RgbImageView small =
      draw_pose(picture.still, *picture.outcome, *picture.rims, *picture.model, false, pixels);
  for (std::int32_t v = 0; v < zoom * small.height_px; ++v) {
    const std::uint8_t* const from =
        small.pixels + static_cast<std::ptrdiff_t>(v / zoom) * small.stride_bytes;
    std::uint8_t* const to = view.pixels + static_cast<std::ptrdiff_t>(v) * view.stride_bytes;
    for (std::int32_t u = 0; u < zoom * small.width_px; ++u) {
      for (std::int32_t part = 0; part < 3; ++part) {
        to[3 * u + part] = from[3 * (u / zoom) + part];
      }
    }
  }
}

void draw_silhouette(Painter& painter, const core::calibration::Silhouette& silhouette,
                     std::int32_t zoom) {
  for (const core::calibration::SilhouetteEdge& edge : silhouette.edges) {
    for (std::int32_t i = 1; i < edge.points_px.size(); ++i) {
      if (edge.measured || i % 2 == 1) {
        painter.line(zoomed(edge.points_px[i - 1], zoom), zoomed(edge.points_px[i], zoom), 2,
                     edge.measured ? palette::kWhite : palette::kCaption);
      }
    }
  }
}

void draw_axis(Painter& painter, const ToolReport& report, std::int32_t zoom) {
  const auto camera = core::camera::make_camera_model<double>(report.camera);
  if (!camera) {
    return;
  }
  constexpr double kFirst_mm = 30.0;
  constexpr int kSteps = 30;
  const double length_mm = report.shape ? report.shape->length_mm : kFirst_mm;
  bool drawing = false;
  PixelPoint before;
  for (int i = 0; i <= kSteps; ++i) {
    const Eigen::Vector3d p =
        report.tool.T_camera_tool * Eigen::Vector3d(0.0, 0.0, -length_mm * i / kSteps);
    const auto pixel = p.z() > 1.0 ? camera->to_pixel({p.x() / p.z(), p.y() / p.z()})
                                   : decltype(camera->to_pixel({0.0, 0.0})){};
    if (!pixel) {
      return;
    }
    const PixelPoint here = zoomed({pixel->x, pixel->y}, zoom);
    if (drawing) {
      painter.line(before, here, 2, palette::kTool);
    } else {
      painter.cross_hair(here, 4, 18, 3, palette::kTool);
    }
    drawing = true;
    before = here;
  }
}

void draw_misses(Painter& painter, const ToolPicture& picture, std::int32_t zoom) {
  const double scale = picture.outcome != nullptr ? kTubeScale : kPointScale;
  for (const ToolMiss& miss : picture.misses) {
    const PixelPoint from = zoomed(miss.at_px, zoom);
    painter.line(from, zoomed(miss.at_px + scale / zoom * miss.off_px, zoom), 2, palette::kColumn);
    if (miss.used) {
      painter.fill({from.u_px - 2, from.v_px - 2, from.u_px + 2, from.v_px + 2}, palette::kColumn);
    } else {
      painter.diagonal_cross(from, 7, 2, palette::kRow);
    }
  }
}

std::vector<std::string> caption_of(const ToolReport& report, const ToolPicture& picture) {
  const auto& v = report.tool.values;
  const auto sigma = [&](int i) { return core::math::sigma_of(report.tool.covariance, i); };
  std::vector<std::string> lines(1);
  drivers::print(lines[0], "tip %.3f %.3f %.3f mm, one sigma %.3f %.3f %.3f", v(0), v(1), v(2),
                 sigma(0), sigma(1), sigma(2));
  if (report.focal) {
    drivers::print(lines[0], ", EFL %.4f +- %.4f mm", report.camera.focal_length_mm,
                   std::sqrt(report.focal->covariance(0, 0)));
  }
  lines.emplace_back("blue: tip and axis");
  if (report.shape) {
    lines.back() += ", white: outline as seen, grey dashes: as computed only";
  }
  lines.emplace_back(
      picture.outcome != nullptr
          ? "green: tube-ends used, orange: rejected, yellow: misses of their centres, "
            "200 times as long"
          : "yellow: points, with their misses 20 times as long, red cross: left out");
  return lines;
}

}  // namespace

std::vector<ToolMiss> tube_misses(const core::pose::PictureOutcome& outcome,
                                  const core::pose::PoseModel& model) {
  std::vector<ToolMiss> misses;
  const core::picture::SheetView view(model.camera, outcome.pose.estimate.T_camera_sheet);
  for (const core::pose::RimVerdict& rim : outcome.pose.rims) {
    const Eigen::Vector2d center = model.center_mm(rim.address);
    const auto at = view.to_pixel(center);
    const auto seen = view.to_pixel(
        Eigen::Vector2d(center + Eigen::Vector2d(rim.center_off_mm[0], rim.center_off_mm[1])));
    if (rim.used && at && seen) {
      misses.push_back({*at, *seen - *at, true});
    }
  }
  return misses;
}

bool write_tool_picture(const std::string& path, const ToolReport& report,
                        const ToolPicture& picture, std::string& message) {
  const std::vector<std::string> caption = caption_of(report, picture);
  const std::int32_t zoom = zoom_of(report.camera);
  core::RgbImageView view;
  view.width_px = zoom * report.camera.width_px;
  const std::int32_t foot = zoom * report.camera.height_px;
  view.height_px = foot + kLine_px * static_cast<std::int32_t>(caption.size() + 1);
  view.stride_bytes = 3 * view.width_px;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(view.stride_bytes) *
                                   static_cast<std::size_t>(view.height_px));
  view.pixels = pixels.data();
  draw_ground(picture, view, zoom);
  Painter painter(view);
  if (report.shape) {
    draw_silhouette(painter, report.silhouette, zoom);
  }
  draw_axis(painter, report, zoom);
  draw_misses(painter, picture, zoom);
  painter.fill({0, foot, view.width_px - 1, view.height_px - 1}, palette::kBlack);
  std::int32_t line = foot + kLine_px / 2;
  for (const std::string& words : caption) {
    painter.text({8, line}, words, 1, palette::kWhite);
    line += kLine_px;
  }
  return drivers::write_png(path, view, message).has_value();
}

}  // namespace tubesight::board
