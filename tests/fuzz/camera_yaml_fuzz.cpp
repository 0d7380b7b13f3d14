// Cameras of OpenCV and ROS: whatever the bytes, either a camera within its limits, which reads
// back as it was written, or one message.
#include "drivers/camera_yaml/camera_yaml.h"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tubesight;
  drivers::CameraYaml camera;
  drivers::Messages messages;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const bool good = drivers::read_camera_yaml(text, "fuzz.yaml", camera, messages).has_value();
  require(good ? messages.empty() : messages.size() == 1);
  if (!good) {
    require(messages[0].find('\n') == std::string::npos);
    return 0;
  }
  require(camera.width_px > 0 && camera.height_px > 0 && camera.fx_px > 0.0 && camera.fy_px > 0.0);
  camera.name = "";  // may hold what our writer does not escape
  drivers::CameraYaml again;
  require(drivers::read_camera_yaml(drivers::camera_yaml_text(camera, drivers::YamlManner::kOpencv),
                                    "again.yaml", again, messages)
              .has_value());
  require(again.fx_px == camera.fx_px && again.distortion == camera.distortion);
  return 0;
}
