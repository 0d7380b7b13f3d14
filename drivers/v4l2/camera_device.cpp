#include "drivers/v4l2/camera_device.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include <linux/videodev2.h>

#include "drivers/v4l2/camera_finder.h"

namespace tubesight::drivers::v4l2 {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

Result<void> refuse(Error error, std::string& message, const std::string& what) {
  message = what;
  return Unexpected(error);
}

}  // namespace

Result<void> CameraDevice::open(std::string& message) {
  const auto opened = open_all(message);
  if (!opened) {
    close();
    message = "camera " + settings_.device + ": " + message;
  }
  return opened;
}

/// The node of the camera that settings name, where there is one of that name.
Result<void> CameraDevice::find(std::string& node, std::string& message) {
  const std::vector<std::string> found = find_cameras(*kernel_, settings_.device);
  if (found.size() == 1) {
    node = found.front();
    return {};
  }
  std::string there;
  for (const CameraInfo& camera : list_cameras(*kernel_)) {
    if (found.empty() || std::ranges::find(found, camera.node) != found.end()) {
      there += (there.empty() ? "" : ", ") + (found.empty() ? camera.name() : camera.place());
    }
  }
  if (found.empty()) {
    return refuse(Error::kDisconnected, message,
                  "is not there, expected one of: " + (there.empty() ? "no camera is" : there));
  }
  return refuse(Error::kUnsupported, message,
                "is there more than once (" + there + "), expected one: name it by its place");
}

Result<void> CameraDevice::open_all(std::string& message) {
  std::string node;
  TUBESIGHT_TRY(find(node, message));
  descriptor_ = kernel_->open(node);
  if (descriptor_ < 0) {
    return refuse(Error::kIo, message, "cannot be opened: " + words_of_refusal(descriptor_));
  }
  agreed_ = {};
  signal_ = Signal::kGood;
  question_.begin();
  TUBESIGHT_TRY(check(node, message));
  // Nothing is set on a camera that another program uses: its input would be switched under it. No
  // buffers are asked for, which only the stranger is refused.
  v4l2_requestbuffers none{};
  none.type = buffer_type_of(agreed_.api);
  none.memory = V4L2_MEMORY_MMAP;
  if (kernel_->ioctl(descriptor_, VIDIOC_REQBUFS, &none) == -EBUSY) {
    return refuse(Error::kIo, message,
                  "is busy: another program takes its pictures, expected it free");
  }
  TUBESIGHT_TRY(keep_input(message));
  TUBESIGHT_TRY(set_up(*kernel_, descriptor_, settings_, question_, agreed_, message));
  TUBESIGHT_TRY(picture_.begin(descriptor_, settings_.controls, message));
  input_ = agreed_.input_status ? static_cast<int>(agreed_.input) : input_;
  TUBESIGHT_TRY(ring_.open(descriptor_, agreed_, settings_.width_px, message));
  identity_.keep(found_);
  return {};
}

/// Settings that name no input take the one found at the first start, not one that somebody has
/// switched to since.
Result<void> CameraDevice::keep_input(std::string& message) {
  int index = 0;
  if (input_ < 0 || !settings_.input.empty() ||
      kernel_->ioctl(descriptor_, VIDIOC_G_INPUT, &index) != 0 || index == input_) {
    return {};
  }
  int wanted = input_;
  const int status = kernel_->ioctl(descriptor_, VIDIOC_S_INPUT, &wanted);
  static_cast<void>(kernel_->ioctl(descriptor_, VIDIOC_G_INPUT, &index));
  if (status == 0 && index == input_) {
    return {};
  }
  return refuse(Error::kIo, message,
                "stands at input " + std::to_string(index) + ", expected " +
                    std::to_string(input_) + ", the one that this box has used so far" +
                    (status == 0 ? "" : std::string(": ") + std::strerror(-status)));
}

Result<void> CameraDevice::check(const std::string& node, std::string& message) {
  v4l2_capability can{};
  if (kernel_->ioctl(descriptor_, VIDIOC_QUERYCAP, &can) != 0) {
    return refuse(Error::kUnsupported, message, "is no camera");
  }
  const auto api = capture_api_of(can);
  if (!api || (caps_of(can) & V4L2_CAP_STREAMING) == 0) {
    return refuse(Error::kUnsupported, message,
                  "is no camera, expected one that streams pictures of one plane");
  }
  agreed_.api = *api;
  found_ = {serial_of(*kernel_, node),
            text_of(can.driver, sizeof can.driver) + " " + text_of(can.card, sizeof can.card)};
  const std::string wrong = identity_.refusal(found_);
  return wrong.empty() ? Result<void>() : refuse(Error::kUnsupported, message, wrong);
}

void CameraDevice::close() {
  if (descriptor_ >= 0) {
    ring_.close();
    kernel_->close(descriptor_);
  }
  descriptor_ = -1;
}

bool CameraDevice::switched() {
  int index = 0;
  return agreed_.input_status && kernel_->ioctl(descriptor_, VIDIOC_G_INPUT, &index) == 0 &&
         static_cast<std::uint32_t>(index) != agreed_.input;
}

/// What the input's state says.
Signal CameraDevice::signal_of_input() {
  v4l2_input input{};
  input.index = agreed_.input;
  if (!agreed_.input_status || kernel_->ioctl(descriptor_, VIDIOC_ENUMINPUT, &input) != 0) {
    return Signal::kGood;
  }
  return says_no_signal(input.status)     ? Signal::kNone
         : says_no_standard(input.status) ? Signal::kOtherStandard
                                          : Signal::kGood;
}

Signal CameraDevice::signal() {
  const Signal before = signal_;
  signal_ = signal_of_input();
  // A driver that makes buffers wait for the answer is asked while none is good anyway: until a
  // signal that was away, or of another standard, is known to be the right one.
  const bool may_ask = !question_.dear() || before != Signal::kGood;
  if (signal_ == Signal::kGood && agreed_.standard != VideoStandard::kNone && may_ask) {
    const VideoStandard sensed = question_.ask(descriptor_);
    signal_ = sensed == VideoStandard::kNone || sensed == agreed_.standard ? Signal::kGood
                                                                           : Signal::kOtherStandard;
  }
  return signal_;
}

}  // namespace tubesight::drivers::v4l2
