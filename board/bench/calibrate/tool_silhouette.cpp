#include "board/bench/calibrate/tool_silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "board/bench/calibrate/tool_inputs.h"
#include "core/camera/camera_setup.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::calibration::GuidetubeShape;
using core::calibration::Silhouette;
using core::calibration::SilhouetteEdge;

// Edges are looked for so far from where they were computed, in units of the guidetube's diameter
// in the picture: the next tube's edges stay out.
constexpr double kReach = 0.12;
constexpr double kLeastReach_px = 5.0;
// A guidetube docked one tube farther away is seen a sixth narrower by the source's camera.
constexpr double kFarReach = 0.5;
constexpr double kOtherWidth = 0.1;
// A tube-end hidden so far inside the outline by so many of its points is not hidden at all.
constexpr double kInside_px = 4.0;
constexpr std::int32_t kThroughPoints = 8;

/// The greatest distance of an edge's points by one standard deviation of the tip and axis.
double sigma_of(const core::camera::CameraModel<double>& camera,
                const core::CameraSettings& settings,
                const core::calibration::ToolCalibration& tool, const GuidetubeShape& shape,
                std::size_t edge, const Silhouette& computed) {
  double variance = 0.0;
  const auto& points = computed.edges[edge].points_px;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3d moved = tool.T_camera_tool.translation_mm();
    moved(axis) += std::sqrt(std::max(0.0, tool.covariance(axis, axis)));
    const Silhouette other =
        core::calibration::computed_silhouette(camera, {tool.T_camera_tool.rotation(), moved},
                                               shape, settings.width_px, settings.height_px);
    const auto& others = other.edges[edge].points_px;
    if (points.empty() || others.empty()) {
      continue;
    }
    variance += (others[0] - points[0]).squaredNorm();
  }
  return std::sqrt(variance);
}

/// From side to side in their middles; 0 where one is not in the picture.
double width_of(const Silhouette& silhouette) {
  const auto& left = silhouette.edge(core::calibration::SilhouettePart::kLeft).points_px;
  const auto& right = silhouette.edge(core::calibration::SilhouettePart::kRight).points_px;
  return left.empty() || right.empty() ? 0.0
                                       : (right[right.size() / 2] - left[left.size() / 2]).norm();
}

bool both_sides(const Silhouette& silhouette, bool measured) {
  return silhouette.edge(core::calibration::SilhouettePart::kLeft).measured == measured &&
         silhouette.edge(core::calibration::SilhouettePart::kRight).measured == measured;
}

/// Whether points stand all around a tube-end's centre: in 20 of 24 sectors.
bool seen_whole(const core::picture::Rim& rim, double u_px, double v_px) {
  constexpr int kSectors = 24;
  constexpr int kMost = 20;
  std::array<bool, kSectors> filled{};
  for (const core::picture::RimPoint& point : rim.points) {
    const double angle = std::atan2(point.v_px - v_px, point.u_px - u_px) / std::numbers::pi;
    const int sector = static_cast<int>(0.5 * (angle + 1.0) * kSectors) % kSectors;
    filled[static_cast<std::size_t>(sector)] = true;
  }
  int count = 0;
  for (const bool sector : filled) {
    count += sector ? 1 : 0;
  }
  return count >= kMost;
}

}  // namespace

bool parse_guidetube(std::string_view text, GuidetubeShape& shape, std::string& message) {
  const std::size_t comma = text.find(',');
  constexpr std::int32_t kDigits = 6;
  std::array<std::int64_t, 2> values{};
  const bool numbers = comma != std::string_view::npos &&
                       drivers::parse_decimal(text.substr(0, comma), kDigits, values[0]) &&
                       drivers::parse_decimal(text.substr(comma + 1), kDigits, values[1]);
  shape = {1e-6 * static_cast<double>(values[0]), 1e-6 * static_cast<double>(values[1])};
  if (!numbers || !(shape.diameter_mm >= 1.0 && shape.diameter_mm <= 200.0) ||
      !(shape.length_mm >= 1.0 && shape.length_mm <= 2000.0)) {
    message = "--guidetube-mm: " + drivers::in_quotes(text) +
              ", expected DIAMETER,LENGTH, 1 to 200 and 1 to 2000 mm";
    return false;
  }
  return true;
}

Silhouette calibrated_silhouette(const core::CameraSettings& settings,
                                 const core::calibration::ToolCalibration& tool,
                                 const GuidetubeShape& shape,
                                 const core::picture::AveragedPicture* picture) {
  const auto camera = core::camera::make_camera_model<double>(settings);
  if (!camera) {
    return {};
  }
  Silhouette result = core::calibration::computed_silhouette(*camera, tool.T_camera_tool, shape,
                                                             settings.width_px, settings.height_px);
  for (std::size_t i = 0; i < result.edges.size(); ++i) {
    result.edges[i].sigma_px = sigma_of(*camera, settings, tool, shape, i, result);
  }
  if (picture != nullptr) {
    core::calibration::measure_silhouette(
        *picture, std::max(kLeastReach_px, kReach * width_of(result)), result);
  }
  return result;
}

std::string silhouette_line(const Silhouette& silhouette, bool looked) {
  std::string line = "  silhouette           ";
  for (std::size_t i = 0; i < silhouette.edges.size(); ++i) {
    const SilhouetteEdge& edge = silhouette.edges[i];
    const std::string name(drivers::kSilhouetteEdges[i]);
    line += (i == 0 ? " " : ", ") + name;
    if (edge.measured) {
      drivers::print(line, " found %+.2f px from its place (%.2f px)", edge.shift_px,
                     edge.sigma_px);
    } else if (edge.points_px.empty()) {
      line += " outside the picture";
    } else {
      drivers::print(line, "%s computed (%.2f px)", looked ? " not found," : "", edge.sigma_px);
    }
  }
  return line + "\n";
}

drivers::SilhouetteSettings silhouette_settings(const GuidetubeShape& shape,
                                                const Silhouette& silhouette) {
  drivers::SilhouetteSettings settings;
  settings.diameter_mm = shape.diameter_mm;
  settings.length_mm = shape.length_mm;
  for (std::size_t i = 0; i < silhouette.edges.size(); ++i) {
    const SilhouetteEdge& edge = silhouette.edges[i];
    drivers::SilhouetteEdgeSettings& to = settings.edges[i];
    to.sigma_px = edge.sigma_px;
    to.measured = edge.measured;
    for (const Eigen::Vector2d& point : edge.points_px) {
      to.points_px.push_back({point.x(), point.y()});
    }
  }
  return settings;
}

std::string why_not_docked(core::TubeAddress named, const core::pose::PictureOutcome& outcome,
                           const core::picture::RimList& rims, const core::pose::PoseModel& model,
                           double height_mm, const Silhouette* silhouette) {
  const std::string docked = "docked on tube " + tube_text(named) + " by --dock, but ";
  const std::string expected =
      ", expected the guidetube in front of it: another tube is docked on, or the clicks have "
      "wrong addresses";
  for (const core::pose::PictureTube& tube : outcome.tubes) {
    if (tube.rim < 0) {
      continue;
    }
    const core::picture::Rim& rim = rims[tube.rim];
    // Also of a rim that the pose rejects, as in glaring light.
    if (tube.address == named && height_mm < 0.25 * model.bore_mm &&
        seen_whole(rim, tube.u_px, tube.v_px)) {
      return docked + "that tube-end is seen whole" + expected;
    }
    if (silhouette != nullptr && tube.used && tube.address != named &&
        core::calibration::points_hidden(*silhouette, rim, kInside_px) >= kThroughPoints) {
      return docked + "tube " + tube_text(tube.address) + " is seen there" + expected;
    }
  }
  return {};
}

std::string why_not_as_wide(core::TubeAddress named, const Silhouette& computed,
                            const GuidetubeShape& shape,
                            const core::picture::AveragedPicture& picture) {
  const double width_px = width_of(computed);
  Silhouette near = computed;
  core::calibration::measure_silhouette(picture, std::max(kLeastReach_px, kReach * width_px), near);
  Silhouette far = computed;
  core::calibration::measure_silhouette(picture, kFarReach * width_px, far);
  if (!both_sides(near, false) || !both_sides(far, true)) {
    return {};
  }
  const double ratio = width_of(far) / width_px;
  if (std::abs(ratio - 1.0) < kOtherWidth) {
    return {};
  }
  std::string why = "docked on tube " + tube_text(named) + " by --dock, but the guidetube is seen ";
  drivers::print(why,
                 "%.1f mm wide if it stands there, expected %.1f mm: another tube is docked on, or "
                 "--guidetube-mm is of another one",
                 ratio * shape.diameter_mm, shape.diameter_mm);
  return why;
}

}  // namespace tubesight::board
