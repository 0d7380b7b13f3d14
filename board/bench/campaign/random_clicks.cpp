#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "board/bench/campaign/random_parts.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::board::campaign {
namespace {

using core::TubeAddress;
using core::rendering::Truth;
using core::rendering::TubeEndKind;
using core::rendering::TubeImage;
using core::tubesheet::center_mm;
using drivers::Scenario;

bool in_window(const std::array<std::int32_t, 4>& window, const TubeImage& image) {
  const auto& [left, top, right, bottom] = window;
  return image.ellipse_px[0] - image.half_px[0] > left &&
         image.ellipse_px[0] + image.half_px[0] < right &&
         image.ellipse_px[1] - image.half_px[1] > top &&
         image.ellipse_px[1] + image.half_px[1] < bottom;
}

// The first three that span a triangle; an angle of 30 degrees at the first is enough.
bool choose_three(const core::TubesheetSettings& sheet, const std::vector<Visible>& visible,
                  std::array<Visible, 3>& chosen) {
  for (std::size_t second = 1; second < visible.size(); ++second) {
    for (std::size_t third = second + 1; third < visible.size(); ++third) {
      const auto a = center_mm(sheet, visible[0].address);
      const auto b = center_mm(sheet, visible[second].address);
      const auto c = center_mm(sheet, visible[third].address);
      const double bx = b[0] - a[0];
      const double by = b[1] - a[1];
      const double cx = c[0] - a[0];
      const double cy = c[1] - a[1];
      if (std::abs(bx * cy - by * cx) > 0.5 * std::hypot(bx, by) * std::hypot(cx, cy)) {
        chosen = {visible[0], visible[second], visible[third]};
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::vector<Visible> list_visible(const Truth& truth, const Pose& T_sheet_tool,
                                  const Scenario& scenario) {
  const auto& start = scenario.told.start;
  const auto plugged = scenario.told.tubesheet.plugged.view();
  std::vector<Visible> visible;
  for (std::int32_t row = 0; row <= kLastAddress; ++row) {
    for (std::int32_t column = 0; column <= kLastAddress; ++column) {
      const TubeAddress address{row, column};
      if (truth.tube_ends().at(address).kind != TubeEndKind::kOpen ||
          std::find(plugged.begin(), plugged.end(), address) != plugged.end()) {
        continue;
      }
      const auto image = truth.tube_image(T_sheet_tool, address);
      if (image && image->rim_in_frame >= 1.0 && image->occluded <= 0.0 &&
          in_window(start.window_px, *image) && image->half_px[1] > 8.0) {
        const double off = std::hypot(image->center_px[0] - start.optimum_px[0],
                                      image->center_px[1] - start.optimum_px[1]);
        visible.push_back({address, *image, off});
      }
    }
  }
  std::sort(visible.begin(), visible.end(), [](const Visible& a, const Visible& b) {
    return a.off_px != b.off_px ? a.off_px < b.off_px : a.address < b.address;
  });
  return visible;
}

bool draw_clicks(RandomSource& random, const Truth& truth, const Pose& T_sheet_tool,
                 const Scenario& scenario, Clicks& clicks) {
  std::array<Visible, 3> chosen{};
  clicks.clear();
  const auto visible = list_visible(truth, T_sheet_tool, scenario);
  if (visible.empty() || !choose_three(scenario.scene.sheet, visible, chosen)) {
    return false;
  }
  for (const Visible& tube : chosen) {
    // Evenly over the inner 60 % of the ellipse, seen as upright.
    const double share = 0.6 * std::sqrt(random.between(0.0, 1.0));
    const double turn = random.between(0.0, 2.0 * std::numbers::pi);
    core::StartPoint point;
    point.address = tube.address;
    point.at_px = {tube.image.ellipse_px[0] + share * tube.image.half_px[0] * std::cos(turn),
                   tube.image.ellipse_px[1] + share * tube.image.half_px[1] * std::sin(turn)};
    static_cast<void>(clicks.try_push_back(point));
  }
  return true;
}

}  // namespace tubesight::board::campaign
