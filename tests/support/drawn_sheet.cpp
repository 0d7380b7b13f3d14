#include "tests/support/drawn_sheet.h"

#include "tests/support/source_camera.h"

namespace tubesight::tests {

using core::Transform;
using core::rendering::Exposure;
using core::rendering::GreyImageView;
using core::rendering::Renderer;
using core::rendering::Scene;
using core::rendering::Truth;

DrawnSheet::DrawnSheet()
    : scene_(std::make_unique<Scene>()),
      renderer_(std::make_unique<Renderer>()),
      truth_(std::make_unique<Truth>()) {
  core::CameraSettings& camera = scene_->camera;
  camera = source_camera();
  camera.scan = core::Scan::kEvenFirst;
  scene_->tool = {{-3.0, 31.6, 112.8}, {0.0, -0.8, 48.0}};
  core::TubesheetSettings& sheet = scene_->sheet;
  sheet.row_step_mm = {0.0, 25.4};
  sheet.column_step_mm = {25.4, 0.0};
  sheet.bore_mm = 18.6;
  sheet.rows = {0, 120};
  sheet.columns = {0, 120};
  static_cast<void>(configure());
}

bool DrawnSheet::configure() {
  return renderer_->configure(*scene_).has_value() && truth_->configure(*scene_).has_value();
}

Exposure DrawnSheet::exposure(double along_mm, double way_mm) const {
  const Eigen::Matrix3d rotation = core::rotation_from_degrees({2.0, 0.0, 0.0});
  Exposure made;
  made.opened = {rotation, {60.0 * 25.4 + along_mm, 40.0 * 25.4, -60.0}};
  made.closed = {rotation, {60.0 * 25.4 + along_mm + way_mm, 40.0 * 25.4, -60.0}};
  return made;
}

std::vector<std::uint8_t> DrawnSheet::picture(std::uint8_t fill) const {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(scene_->camera.width_px) *
                                       static_cast<std::size_t>(scene_->camera.height_px),
                                   fill);
}

GreyImageView DrawnSheet::view(std::vector<std::uint8_t>& picture) const {
  return {picture.data(), scene_->camera.width_px, scene_->camera.height_px,
          scene_->camera.width_px};
}

std::vector<std::uint8_t> DrawnSheet::draw(const Exposure& exposure) {
  std::vector<std::uint8_t> drawn = picture();
  renderer_->render(exposure, view(drawn));
  return drawn;
}

void make_plain(Scene& scene) {
  scene.look.texture = 0.0;
  scene.look.stains = 0.0;
  scene.look.gloss = 0.0;
  scene.look.weld_mm = 0.0;
  scene.look.nicked = 0.0;
  scene.look.bore_spread_mm = 0.0;
  scene.look.wall = 0.0;
  scene.sensor.veil = 0.0;
  scene.sensor.blooming = 0.0;
  scene.sensor.shot_noise = 0.0;
  scene.sensor.read_noise = 0.0;
}

}  // namespace tubesight::tests
