#include <algorithm>
#include <cmath>
#include <cstdint>

#include "board/bench/campaign/random_parts.h"

namespace tubesight::board::campaign {
namespace {

using core::CameraSettings;
using core::Scan;
using core::ToolSettings;
using drivers::Scenario;

void draw_internals(RandomSource& random, CameraSettings& camera) {
  camera.width_px = 635;
  camera.height_px = 480;
  camera.scan = random.chance(0.5) ? Scan::kEvenFirst : Scan::kOddFirst;
  camera.focal_length_mm = random.between(4.9, 5.15);
  camera.cell_width_mm = 0.0084;
  camera.cell_height_mm = 0.0098;
  camera.sensor_columns = 768;
  camera.frame_columns = 635;
  camera.horizontal_scale = random.between(1.0, 1.045);
  camera.center_px = {random.between(307.0, 327.0), random.between(231.0, 249.0)};
  camera.distortion_per_mm2 = random.between(0.0080, 0.0110);
  camera.distortion2_per_mm4 = 0.0;
}

// The camera looks up aslant from beside the guidetube; `quarter` turns it about its optical axis.
void draw_place(RandomSource& random, double pitch, std::int32_t quarter, ToolSettings& tool) {
  const double x = random.between(-5.0, 5.0);
  const double y = random.between(26.0, 34.0);
  tool.position_mm = {x, y, pitch * random.between(4.4, 5.3)};
  tool.rotation_deg = {random.normal(0.5), random.normal(0.5), random.between(42.0, 50.0)};
  if (quarter != 0) {
    tool.position_mm[0] = -quarter * y;
    tool.position_mm[1] = quarter * x;
    tool.rotation_deg[0] += 90.0 * quarter;
  }
}

// What a calibration leaves: a few hundredths of a millimetre at the sheet.
void draw_calibration(RandomSource& random, Scenario& scenario) {
  CameraSettings& camera = scenario.told.camera;
  camera = scenario.scene.camera;
  camera.focal_length_mm *= 1.0 + random.normal(0.0003);
  camera.horizontal_scale *= 1.0 + random.normal(0.0002);
  camera.center_px[0] += random.normal(0.2);
  camera.center_px[1] += random.normal(0.2);
  camera.distortion_per_mm2 *= 1.0 + random.normal(0.005);
  ToolSettings& tool = scenario.told.tool;
  tool = scenario.scene.tool;
  for (std::size_t i = 0; i < 3; ++i) {
    tool.position_mm[i] += random.normal(0.03);
    tool.rotation_deg[i] += random.normal(0.015);
  }
}

// The part of the picture above the guidetube: for a turned camera the same part, turned.
void draw_window(RandomSource& random, std::int32_t quarter, core::StartSettings& start) {
  const std::int32_t side = random.whole(24, 44);
  const std::int32_t far = random.whole(24, 44);
  const std::int32_t near = random.whole(296, 350);
  if (quarter == 0) {
    start.window_px = {side, far, 634 - side, near};
    start.optimum_px = {317.0, random.between(165.0, 215.0)};
    return;
  }
  // Rows of the upright window become columns, 1.19 times as many for the same angle.
  const auto column = [quarter](std::int32_t row) {
    return 317 - static_cast<std::int32_t>(std::lround(quarter * (row - 240) * 1.19));
  };
  const std::int32_t a = column(far);
  const std::int32_t b = column(near);
  start.window_px = {std::min(a, b), side / 2, std::max(a, b), 479 - side / 2};
  start.optimum_px = {static_cast<double>(column(random.whole(165, 215))), 240.0};
}

}  // namespace

void draw_camera(const Stratum& stratum, RandomSource& random, Scenario& scenario) {
  std::int32_t quarter = 0;
  if (stratum.mounting == Mounting::kTurned) {
    quarter = random.chance(0.5) ? 1 : -1;
  }
  draw_internals(random, scenario.scene.camera);
  draw_place(random, pitch_mm(scenario.scene.sheet), quarter, scenario.scene.tool);
  draw_calibration(random, scenario);
  draw_window(random, quarter, scenario.told.start);
  scenario.told.verification.aligned_within_mm = 2.5;
  scenario.video.rate_numerator = random.chance(0.5) ? 30 : 25;
  scenario.video.rate_denominator = 1;
  scenario.video.exposure_s = random.between(0.0005, 0.004);
  scenario.video.window_margin_px = 24;
}

void draw_light(RandomSource& random, Scenario& scenario) {
  auto& lamp = scenario.scene.lamp;
  lamp.ring_radius_mm = random.between(31.0, 40.0);
  lamp.below_tip_mm = random.between(42.0, 60.0);
  lamp.strength = random.between(0.9, 1.3);
  lamp.beam = random.between(1.5, 3.0);
  lamp.ambient = random.between(0.0, 0.03);
  auto& sensor = scenario.scene.sensor;
  sensor.blur_px = random.between(0.6, 1.1);
  sensor.vignetting = random.between(0.1, 0.4);
  sensor.veil = random.between(0.0, 0.02);
  sensor.blooming = random.between(0.0, 0.2);
  sensor.gain = random.between(0.9, 1.1);
  sensor.offset = random.between(0.0, 8.0);
  sensor.shot_noise = random.between(0.05, 0.14);
  sensor.read_noise = random.between(0.5, 1.5);
  sensor.salt_and_pepper = random.chance(0.1) ? random.between(0.0, 0.0005) : 0.0;
  sensor.emi_share = random.chance(0.1) ? random.between(0.0, 0.02) : 0.0;
  sensor.emi_amplitude = random.between(5.0, 25.0);
  auto& guidetube = scenario.scene.guidetube;
  guidetube.radius_mm = scenario.scene.sheet.bore_mm * random.between(0.42, 0.52);
  guidetube.length_mm = random.between(100.0, 125.0);
  guidetube.reflectance = random.between(0.15, 0.45);
  scenario.light.lamp_permille = random.whole(850, 1000);
  scenario.light.pwm_hz = 0.0;
  scenario.light.ring = 0.0;
}

}  // namespace tubesight::board::campaign
