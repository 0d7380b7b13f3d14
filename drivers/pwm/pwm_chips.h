#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tubesight::drivers {

/// Where the kernel has its PWM chips.
inline constexpr const char* kPwmClass = "/sys/class/pwm";

/// A PWM chip as the system knows it.
struct PwmChip {
  std::string name;    ///< "pwmchip0", which may change from one start to the next
  std::string device;  ///< "fe20c000.pwm", which stays: what settings should name; may be empty
  std::int32_t channels = 0;
};

/// The chips below `root` (of kPwmClass), by name. Opens none.
[[nodiscard]] std::vector<PwmChip> list_pwm_chips(const std::string& root);

/// The folder of the chip with this device or name; empty when it is not there.
[[nodiscard]] std::string find_pwm_chip(const std::string& root, const std::string& wanted);

}  // namespace tubesight::drivers
