#include "drivers/v4l2/camera_finder.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string_view>

#include <linux/videodev2.h>

#include "drivers/v4l2/camera_controls.h"
#include "drivers/v4l2/capture_api.h"
#include "drivers/v4l2/pixel_format.h"
#include "drivers/v4l2/video_standard.h"

namespace tubesight::drivers::v4l2 {
namespace {

constexpr std::string_view kBus = "bus:";
constexpr std::string_view kSerial = "serial:";
constexpr std::string_view kById = "/dev/v4l/by-id/";
constexpr const char* kClass = "/sys/class/video4linux";
/// Entries of one list that a driver is asked for: one that never ends must not hold us.
constexpr std::uint32_t kMostEntries = 64;

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }
std::string parent(const std::string& path) { return path.substr(0, path.rfind('/')); }

/// A descriptor as long as it is needed.
class Opened {
 public:
  Opened(Kernel& kernel, const std::string& node)
      : kernel_(&kernel), descriptor_(kernel.open(node)) {}
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened() {
    if (descriptor_ >= 0) {
      kernel_->close(descriptor_);
    }
  }
  [[nodiscard]] bool good() const { return descriptor_ >= 0; }
  [[nodiscard]] std::string why() const { return words_of_refusal(descriptor_); }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] int call(unsigned long request, void* argument) const {
    return good() ? kernel_->ioctl(descriptor_, request, argument) : -EBADF;
  }
  [[nodiscard]] bool ask(unsigned long request, void* argument) const {
    return call(request, argument) == 0;
  }

 private:
  Kernel* kernel_;
  int descriptor_;
};

/// Whether a node gives pictures; nodes for their descriptions beside it do not.
bool captures(const v4l2_capability& can) { return capture_api_of(can).has_value(); }

std::string link_to(Kernel& kernel, const std::string& folder, const std::string& node) {
  for (const std::string& name : kernel.list(folder)) {
    if (kernel.real_path(folder + "/" + name) == node) {
      return folder + "/" + name;
    }
  }
  return {};
}

std::string size_words(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

void list_inputs(const Opened& camera, CameraInfo& info) {
  v4l2_std_id known = 0;
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_input input{};
    input.index = i;
    if (!camera.ask(VIDIOC_ENUMINPUT, &input)) {
      break;
    }
    info.inputs.push_back(text_of(input.name, sizeof input.name));
    known |= input.std;
  }
  for (const v4l2_std_id standard : {V4L2_STD_525_60, V4L2_STD_625_50}) {
    if ((known & standard) != 0) {
      info.standards.emplace_back(name_of(standard_of(standard)));
    }
  }
  v4l2_std_id set = 0;
  if (!info.standards.empty() && camera.ask(VIDIOC_G_STD, &set) &&
      standard_of(set) != VideoStandard::kNone) {
    info.standard = name_of(standard_of(set));
  }
}

/// Whether another program has its buffers; none are asked for, which only the stranger is refused.
bool taken_by_another(const Opened& camera, CaptureApi api) {
  v4l2_requestbuffers none{};
  none.type = buffer_type_of(api);
  none.memory = V4L2_MEMORY_MMAP;
  return camera.call(VIDIOC_REQBUFS, &none) == -EBUSY;
}

/// The sizes of a format: one by one, or the smallest and the largest.
std::string sizes_of(const Opened& camera, std::uint32_t code) {
  std::string text;
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_frmsizeenum size{};
    size.index = i;
    size.pixel_format = code;
    if (!camera.ask(VIDIOC_ENUM_FRAMESIZES, &size)) {
      break;
    }
    text += text.empty() ? " " : ", ";
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
      return text + size_words(size.stepwise.min_width, size.stepwise.min_height) + " to " +
             size_words(size.stepwise.max_width, size.stepwise.max_height);
    }
    text += size_words(size.discrete.width, size.discrete.height);
  }
  return text;
}

void list_formats(const Opened& camera, CaptureApi api, CameraInfo& info) {
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_fmtdesc format{};
    format.index = i;
    format.type = buffer_type_of(api);
    if (!camera.ask(VIDIOC_ENUM_FMT, &format)) {
      return;
    }
    std::string name = code_text(format.pixelformat).data();
    bool ours = false;
    for (const PixelFormat& known : pixel_formats()) {
      if (known.code == format.pixelformat) {
        name = known.name;
        ours = true;
      }
    }
    info.formats.push_back(name + sizes_of(camera, format.pixelformat) +
                           (ours ? "" : " (not taken)"));
  }
}

}  // namespace

std::string words_of_refusal(int status) {
  return std::string(std::strerror(-status)) +
         (status == -EACCES ? ", expected a user of the group video" : "");
}

std::string text_of(const unsigned char* letters, std::size_t length) {
  std::string text;
  for (std::size_t i = 0; i < length && letters[i] != 0; ++i) {
    if (letters[i] >= 0x20 && letters[i] < 0x7f) {
      text += static_cast<char>(letters[i]);
    }
  }
  return text;
}

// Of what keeps a place it says where the camera is plugged in; by-id, which camera it is. Neither
// says it of two cameras of a maker who gives them no numbers: the place does.
std::string CameraInfo::name() const {
  if (!serial.empty() && alone) {
    return "serial:" + serial;
  }
  return by_path.empty() && !by_id.empty() ? by_id : place();
}

std::string CameraInfo::place() const {
  if (!by_path.empty()) {
    return by_path;
  }
  return bus.empty() ? node : "bus:" + bus;
}

std::string serial_of(Kernel& kernel, const std::string& node) {
  // From the interface up to the device, on USB; others have it at once or nowhere. One level
  // further up there is a hub, which has a number of its own.
  constexpr int kLevels = 2;
  std::string device = kernel.real_path(std::string(kClass) + "/" + file_name(node) + "/device");
  for (int level = 0; level < kLevels && !device.empty(); ++level) {
    const std::string serial = kernel.first_line(device + "/serial");
    if (!serial.empty()) {
      return serial;
    }
    device = parent(device);
  }
  return {};
}

std::vector<CameraInfo> list_cameras(Kernel& kernel) {
  std::vector<CameraInfo> cameras;
  for (const std::string& name : kernel.list(kClass)) {
    CameraInfo info;
    info.node = "/dev/" + name;
    const Opened camera(kernel, info.node);
    v4l2_capability can{};
    info.refused = camera.good() ? "" : camera.why();
    if (camera.good() && (!camera.ask(VIDIOC_QUERYCAP, &can) || !captures(can))) {
      continue;
    }
    info.bus = text_of(can.bus_info, sizeof can.bus_info);
    info.card = text_of(can.card, sizeof can.card);
    info.driver = text_of(can.driver, sizeof can.driver);
    info.serial = serial_of(kernel, info.node);
    info.by_id = link_to(kernel, "/dev/v4l/by-id", info.node);
    info.by_path = link_to(kernel, "/dev/v4l/by-path", info.node);
    list_inputs(camera, info);
    const CaptureApi api = capture_api_of(can).value_or(CaptureApi::kWhole);
    list_formats(camera, api, info);
    if (camera.good()) {
      info.taken = taken_by_another(camera, api);
      info.controls = control_names(kernel, camera.descriptor());
    }
    cameras.push_back(info);
  }
  for (CameraInfo& camera : cameras) {
    camera.alone = std::ranges::count(cameras, camera.serial, &CameraInfo::serial) == 1;
  }
  return cameras;
}

namespace {

/// The nodes of all cameras that have the name of this one below by-id, where the link leads to
/// whichever came last. Several nodes of one device have names of their own.
std::vector<std::string> alike(Kernel& kernel, const std::string& node) {
  const std::vector<CameraInfo> cameras = list_cameras(kernel);
  const auto own = std::ranges::find(cameras, node, &CameraInfo::node);
  const auto device = [&](const std::string& of) {
    return kernel.real_path(std::string(kClass) + "/" + file_name(of) + "/device");
  };
  std::vector<std::string> found{node};
  for (const CameraInfo& camera : cameras) {
    if (own != cameras.end() && camera.node != node && camera.serial == own->serial &&
        camera.driver == own->driver && camera.card == own->card &&
        device(camera.node) != device(node)) {
      found.push_back(camera.node);
    }
  }
  return found;
}

}  // namespace

std::vector<std::string> find_cameras(Kernel& kernel, const std::string& device) {
  std::vector<std::string> found;
  if (device.starts_with('/')) {
    const std::string node = kernel.real_path(device);
    if (node.empty()) {
      return found;
    }
    return device.starts_with(kById) ? alike(kernel, node) : std::vector{node};
  }
  const bool by_bus = device.starts_with(kBus);
  const std::string wanted = device.substr(by_bus ? kBus.size() : kSerial.size());
  for (const std::string& name : kernel.list(kClass)) {
    const std::string node = "/dev/" + name;
    if (!by_bus && serial_of(kernel, node) != wanted) {
      continue;
    }
    const Opened camera(kernel, node);
    v4l2_capability can{};
    if (!camera.ask(VIDIOC_QUERYCAP, &can) || !captures(can)) {
      continue;
    }
    if (!by_bus || text_of(can.bus_info, sizeof can.bus_info) == wanted) {
      found.push_back(node);
    }
  }
  return found;
}

}  // namespace tubesight::drivers::v4l2
