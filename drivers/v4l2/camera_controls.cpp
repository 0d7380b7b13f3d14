#include "drivers/v4l2/camera_controls.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include <linux/videodev2.h>

#include "drivers/v4l2/camera_finder.h"

namespace tubesight::drivers::v4l2 {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// Controls that a driver is asked for: more than any has.
constexpr int kMostControls = 512;

constexpr char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::vector<v4l2_queryctrl> list_controls(Kernel& kernel, int descriptor) {
  std::vector<v4l2_queryctrl> controls;
  v4l2_queryctrl control{};
  for (int i = 0; i < kMostControls; ++i) {
    control.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
    if (kernel.ioctl(descriptor, VIDIOC_QUERYCTRL, &control) != 0) {
      break;
    }
    const bool heading = control.type == V4L2_CTRL_TYPE_CTRL_CLASS;
    if (!heading && (control.flags & V4L2_CTRL_FLAG_DISABLED) == 0) {
      controls.push_back(control);
    }
  }
  return controls;
}

std::optional<std::int32_t> whole(const std::string& text) {
  std::int32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value)
                                                                  : std::nullopt;
}

/// The value that a setting means; empty, with the message, where the control has none such.
std::optional<std::int32_t> value_of(Kernel& kernel, int descriptor, const v4l2_queryctrl& control,
                                     const ControlSetting& wanted, std::string& message) {
  std::string offered;
  if (control.type == V4L2_CTRL_TYPE_MENU) {
    for (std::int32_t i = control.minimum; i <= control.maximum; ++i) {
      v4l2_querymenu entry{};
      entry.id = control.id;
      entry.index = static_cast<std::uint32_t>(i);
      if (kernel.ioctl(descriptor, VIDIOC_QUERYMENU, &entry) != 0) {
        continue;
      }
      const std::string name = text_of(entry.name, sizeof entry.name);
      if (same_name(name, wanted.value)) {
        return i;
      }
      offered += (offered.empty() ? "'" : ", '") + name + "'";
    }
  }
  const auto number = whole(wanted.value);
  if (number && *number >= control.minimum && *number <= control.maximum) {
    return number;
  }
  message =
      "control '" + wanted.name + "': '" + wanted.value + "', expected " +
      (offered.empty() ? std::to_string(control.minimum) + " to " + std::to_string(control.maximum)
                       : offered);
  return {};
}

Result<void> set_control(Kernel& kernel, int descriptor, const v4l2_queryctrl& control,
                         const ControlSetting& wanted, std::string& message) {
  const auto value = value_of(kernel, descriptor, control, wanted, message);
  if (!value) {
    return Unexpected(Error::kUnsupported);
  }
  v4l2_control set{control.id, *value};
  if (const int status = kernel.ioctl(descriptor, VIDIOC_S_CTRL, &set); status != 0) {
    message = "control '" + wanted.name + "': " + std::strerror(-status);
    return Unexpected(Error::kIo);
  }
  v4l2_control kept{control.id, *value};
  if ((control.flags & V4L2_CTRL_FLAG_WRITE_ONLY) == 0 &&
      kernel.ioctl(descriptor, VIDIOC_G_CTRL, &kept) == 0 && kept.value != *value) {
    message = "control '" + wanted.name + "': is " + std::to_string(kept.value) + ", expected " +
              std::to_string(*value);
    return Unexpected(Error::kIo);
  }
  return {};
}

}  // namespace

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

std::vector<std::string> control_names(Kernel& kernel, int descriptor) {
  std::vector<std::string> names;
  for (const v4l2_queryctrl& control : list_controls(kernel, descriptor)) {
    names.push_back(text_of(control.name, sizeof control.name));
  }
  return names;
}

Result<void> set_controls(Kernel& kernel, int descriptor,
                          const std::vector<ControlSetting>& controls, std::string& message) {
  if (controls.empty()) {
    return {};
  }
  const std::vector<v4l2_queryctrl> offered = list_controls(kernel, descriptor);
  for (const ControlSetting& wanted : controls) {
    const auto found =
        std::find_if(offered.begin(), offered.end(), [&](const v4l2_queryctrl& control) {
          return same_name(text_of(control.name, sizeof control.name), wanted.name);
        });
    if (found == offered.end()) {
      std::string names;
      for (const v4l2_queryctrl& control : offered) {
        names += (names.empty() ? "'" : ", '") + text_of(control.name, sizeof control.name) + "'";
      }
      message = "has no control '" + wanted.name + "', offers " + (names.empty() ? "none" : names);
      return Unexpected(Error::kUnsupported);
    }
    TUBESIGHT_TRY(set_control(kernel, descriptor, *found, wanted, message));
  }
  return {};
}

}  // namespace tubesight::drivers::v4l2
