// The half of FakeKernel that is /dev and /sys.

#include "tests/drivers/v4l2/fake_kernel.h"

namespace tubesight::tests {

std::vector<std::string> FakeKernel::list(const std::string& folder) {
  std::vector<std::string> names;
  if (folder == "/sys/class/video4linux") {
    for (const auto& [number, camera] : cameras_) {
      names.push_back("video" + std::to_string(number));
    }
  }
  for (const auto& [from, to] : links_) {
    if (from.starts_with(folder + "/")) {
      names.push_back(from.substr(folder.size() + 1));
    }
  }
  return names;
}

std::string FakeKernel::real_path(const std::string& path) {
  const std::string sysfs = "/sys/class/video4linux/";
  if (path.starts_with(sysfs)) {
    return "/sys/devices/" + path.substr(sysfs.size());
  }
  const auto link = links_.find(path);
  const std::string real = link == links_.end() ? path : link->second;
  const std::string node = "/dev/video";
  if (!real.starts_with(node) || !cameras_.contains(std::stoi(real.substr(node.size())))) {
    return {};
  }
  return real;
}

std::string FakeKernel::first_line(const std::string& path) {
  // As on USB: the serial number stands one level above the interface, and that of a hub above.
  if (path == "/sys/devices/serial") {
    return "of the hub";
  }
  const std::string begin = "/sys/devices/video";
  if (!path.starts_with(begin) || !path.ends_with("/serial") ||
      path.find("/device/") != std::string::npos) {
    return {};
  }
  const auto at = cameras_.find(std::stoi(path.substr(begin.size())));
  return at == cameras_.end() ? std::string() : at->second->serial;
}

}  // namespace tubesight::tests
