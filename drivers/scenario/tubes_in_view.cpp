#include "drivers/scenario/tubes_in_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/tubesheet/sheet_places.h"

namespace tubesight::drivers {
namespace {

using core::rendering::TubeEndKind;
using Vector = std::array<double, 2>;

double distance(const Vector& a, const Vector& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Twice the area of a triangle over the square of its longest side.
double fatness(const Vector& a, const Vector& b, const Vector& c) {
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const double longest = std::max({distance(a, b), distance(b, c), distance(a, c)});
  return std::abs(area) / (longest * longest);
}

/// Whether a rim about this centre can reach into the picture: no rim is as wide as the picture.
bool near_picture(const std::optional<Vector>& center_px, const core::CameraSettings& camera) {
  return center_px && (*center_px)[0] > -0.5 * camera.width_px &&
         (*center_px)[0] < 1.5 * camera.width_px && (*center_px)[1] > -0.5 * camera.height_px &&
         (*center_px)[1] < 1.5 * camera.height_px;
}

bool clear(const TubeInView& tube, const core::StartSettings& start) {
  const auto& [left, top, right, bottom] = start.window_px;
  const auto& [u, v] = tube.image.ellipse_px;
  const auto& [half_u, half_v] = tube.image.half_px;
  constexpr double kLeastHalf_px = 8.0;  // smaller ones are not measured
  return tube.end.kind == TubeEndKind::kOpen && tube.image.occluded == 0.0 &&
         half_v >= kLeastHalf_px && u - half_u >= left && u + half_u <= right &&
         v - half_v >= top && v + half_v <= bottom;
}

}  // namespace

void list_tubes_in_view(const core::rendering::Truth& truth, const core::rendering::Scene& scene,
                        const drivers::FieldTruth& field, const drivers::FieldFaults& faults,
                        std::vector<TubeInView>& tubes) {
  tubes.clear();
  const core::CameraSettings& camera = scene.camera;
  // Farther away than this from the tool a tube-end is too small to matter, even for a camera that
  // looks along the sheet.
  constexpr double kFarthest_mm = 600.0;
  const auto& tip = field.T_sheet_tool.translation_mm();
  const auto block =
      core::tubesheet::addresses_within(scene.sheet, kFarthest_mm, {tip.x(), tip.y()});
  for (std::int32_t row = block.rows[0]; row <= block.rows[1]; ++row) {
    for (std::int32_t column = block.columns[0]; column <= block.columns[1]; ++column) {
      const auto end = truth.tube_ends().at({row, column});
      if (!near_picture(truth.image_of(field.T_sheet_tool, end.center_mm, faults.knock), camera)) {
        continue;
      }
      const auto image = truth.tube_image(field.T_sheet_tool, {row, column}, faults.knock);
      if (image && image->rim_in_frame > 0.0) {
        tubes.push_back({{row, column}, end, *image});
      }
    }
  }
}

std::vector<TubeInView> choose_start_tubes(const std::vector<TubeInView>& in_view,
                                           const core::StartSettings& start) {
  std::vector<TubeInView> candidates;
  for (const TubeInView& tube : in_view) {
    if (clear(tube, start)) {
      candidates.push_back(tube);
    }
  }
  if (candidates.empty()) {
    return {};
  }
  const auto by = [](const Vector& place) {
    return [place](const TubeInView& a, const TubeInView& b) {
      return distance(a.image.center_px, place) < distance(b.image.center_px, place);
    };
  };
  std::vector<TubeInView> chosen = {
      *std::min_element(candidates.begin(), candidates.end(), by(start.optimum_px))};
  std::sort(candidates.begin(), candidates.end(), by(chosen.front().image.center_px));
  for (std::size_t i = 1; i < candidates.size() && chosen.size() < 3; ++i) {
    // An equilateral triangle has 0.87, the half of a square 0.5.
    constexpr double kThinnest = 0.3;
    const TubeInView& next = candidates[i];
    if (chosen.size() < 2 || fatness(chosen[0].image.center_px, chosen[1].image.center_px,
                                     next.image.center_px) >= kThinnest) {
      chosen.push_back(next);
    }
  }
  return chosen;
}

}  // namespace tubesight::drivers
