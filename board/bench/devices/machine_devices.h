#pragma once

#include <string>
#include <vector>

#include "drivers/aravis/library.h"
#include "drivers/gpio/line_bank.h"
#include "drivers/pwm/pwm_chips.h"
#include "drivers/v4l2/camera_finder.h"

namespace tubesight::board {

/// The lists for a person: each device by the name to write into the settings, with what it offers.
[[nodiscard]] std::string cameras_text(const std::vector<drivers::v4l2::CameraInfo>& cameras);
[[nodiscard]] std::string network_cameras_text(
    const std::vector<drivers::aravis::CameraInfo>& cameras);
[[nodiscard]] std::string gpio_text(const std::vector<drivers::GpioChip>& chips);
[[nodiscard]] std::string pwm_text(const std::vector<drivers::PwmChip>& chips);

}  // namespace tubesight::board
