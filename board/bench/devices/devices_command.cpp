#include "board/bench/devices/devices_command.h"

#include <string>
#include <vector>

#include "board/bench/devices/machine_devices.h"
#include "board/bench/devices/serial_ports.h"
#include "board/bench/output/text_output.h"

namespace tubesight::board {

namespace {

std::string network_text() {
  std::vector<drivers::aravis::CameraInfo> cameras;
  std::string why;
  if (!drivers::aravis::system_library().list(cameras, why)) {
    return "no network cameras: " + why + "\n";
  }
  return network_cameras_text(cameras);
}

}  // namespace

ExitStatus run_devices(const DevicesOptions& options) {
  const std::string text =
      cameras_text(drivers::v4l2::list_cameras(drivers::v4l2::system_kernel())) +
      (options.network ? network_text() : std::string()) + gpio_text(drivers::list_gpio_chips()) +
      pwm_text(drivers::list_pwm_chips(drivers::kPwmClass)) +
      serial_ports_text(list_serial_ports(""));
  return write_out(text) ? ExitStatus::kDone : ExitStatus::kJobFailed;
}

}  // namespace tubesight::board
