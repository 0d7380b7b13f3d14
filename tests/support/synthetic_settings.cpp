// The settings of synthetic_sheet.h's ordinary camera, tool and sheet.
#include "tests/support/synthetic_sheet.h"

namespace tubesight::tests {

void make_synthetic_settings(core::SessionSettings& settings, std::int32_t divisor) {
  settings = {};
  auto& camera = settings.camera;
  const double share = 1.0 / divisor;
  camera.width_px = 635 / divisor;
  camera.height_px = 480 / divisor;
  camera.scan = core::Scan::kEvenFirst;
  camera.focal_length_mm = 5.06;
  camera.cell_width_mm = 0.0084 * divisor;
  camera.cell_height_mm = 0.0098 * divisor;
  camera.sensor_columns = 768;
  camera.frame_columns = 635;
  camera.horizontal_scale = 1.021;
  camera.center_px = {324.3 * share, 233.8 * share};
  camera.distortion_per_mm2 = 0.0092;
  settings.tool.position_mm = {-3.0, 31.5, 112.5};
  settings.tool.rotation_deg = {-0.1, -0.8, 48.0};
  auto& sheet = settings.tubesheet;
  sheet.row_step_mm = {0.0, 25.4};
  sheet.column_step_mm = {25.4, 0.0};
  sheet.bore_mm = 18.6;
  sheet.rows = {-50, 150};
  sheet.columns = {-50, 150};
  const auto scaled = [divisor](std::int32_t px) { return px / divisor; };
  settings.start.window_px = {scaled(40), scaled(36), scaled(595), scaled(330)};
  settings.start.optimum_px = {318.0 * share, 190.0 * share};
}

void set_clicks(const SyntheticSheet& sheet, const ToolPlace& place,
                const std::vector<core::TubeAddress>& addresses,
                const std::array<double, 2>& off_px, core::SessionSettings& settings) {
  settings.start.tubes.clear();
  for (const core::TubeAddress& address : addresses) {
    const auto at = sheet.image_of(place, address);
    static_cast<void>(
        settings.start.tubes.try_push_back({address, {at[0] + off_px[0], at[1] + off_px[1]}}));
  }
}

}  // namespace tubesight::tests
