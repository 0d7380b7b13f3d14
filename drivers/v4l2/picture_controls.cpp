#include "drivers/v4l2/picture_controls.h"

#include <algorithm>
#include <array>

#include <linux/videodev2.h>

#include "drivers/v4l2/camera_controls.h"
#include "drivers/v4l2/camera_finder.h"

namespace tubesight::drivers::v4l2 {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::array<std::uint32_t, 6> kControls{V4L2_CID_HFLIP,         V4L2_CID_VFLIP,
                                                 V4L2_CID_ROTATE,        V4L2_CID_PAN_ABSOLUTE,
                                                 V4L2_CID_TILT_ABSOLUTE, V4L2_CID_ZOOM_ABSOLUTE};

}  // namespace

Result<void> PictureControls::begin(int descriptor, const std::vector<ControlSetting>& wanted,
                                    std::string& message) {
  kept_.clear();
  for (const std::uint32_t id : kControls) {
    v4l2_queryctrl control{};
    control.id = id;
    if (kernel_->ioctl(descriptor, VIDIOC_QUERYCTRL, &control) != 0 ||
        (control.flags & (V4L2_CTRL_FLAG_DISABLED | V4L2_CTRL_FLAG_WRITE_ONLY)) != 0) {
      continue;
    }
    // Before it is read: a change in between would be missed.
    v4l2_event_subscription change{};
    change.type = V4L2_EVENT_CTRL;
    change.id = id;
    static_cast<void>(kernel_->ioctl(descriptor, VIDIOC_SUBSCRIBE_EVENT, &change));
    v4l2_control now{id, 0};
    if (kernel_->ioctl(descriptor, VIDIOC_G_CTRL, &now) != 0) {
      continue;
    }
    const std::string name = text_of(control.name, sizeof control.name);
    const bool meant = std::ranges::any_of(
        wanted, [&](const ControlSetting& each) { return same_name(each.name, name); });
    if (now.value != control.default_value && !meant) {
      message = "control '" + name + "': is " + std::to_string(now.value) + ", expected " +
                std::to_string(control.default_value) +
                " as it is by default, or the value that is meant in controls";
      return Unexpected(Error::kUnsupported);
    }
    static_cast<void>(kept_.try_push_back({id, now.value}));  // as many as there are
  }
  return {};
}

bool PictureControls::changed(int descriptor) const {
  return std::any_of(kept_.begin(), kept_.end(), [&](const Kept& kept) {
    v4l2_control now{kept.id, kept.value};
    return kernel_->ioctl(descriptor, VIDIOC_G_CTRL, &now) == 0 && now.value != kept.value;
  });
}

}  // namespace tubesight::drivers::v4l2
