#include <algorithm>
#include <cstdint>
#include <memory>
#include <string_view>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/aravis/camera_choice.h"
#include "drivers/aravis/functions.h"
#include "drivers/aravis/library.h"
#include "drivers/aravis/refusal.h"
#include "drivers/aravis/system_device.h"

namespace tubesight::drivers::aravis {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::string_view kAddress = "address:";
constexpr std::string_view kSerial = "serial:";
/// Of GigE Vision's control channel. Nothing is sent to it here.
constexpr std::uint16_t kControlPort = 3956;

std::string text_of(const char* text) { return text != nullptr ? text : ""; }

/// The address of ours from which another one is reached; empty where none is. Sends nothing.
std::string own_address_towards(const std::string& address) {
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(kControlPort);
  if (inet_pton(AF_INET, address.c_str(), &there.sin_addr) != 1) {
    return {};
  }
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) {
    return {};
  }
  sockaddr_in here{};
  socklen_t length = sizeof here;
  std::string own;
  if (connect(descriptor, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0 &&
      getsockname(descriptor, reinterpret_cast<sockaddr*>(&here), &length) == 0) {
    char text[INET_ADDRSTRLEN] = {};
    own = text_of(inet_ntop(AF_INET, &here.sin_addr, text, sizeof text));
  }
  close(descriptor);
  return own;
}

class SystemLibrary final : public Library {
 public:
  [[nodiscard]] Result<Device*> open(const std::string& device, std::string& why) override;
  void close(Device& device) override;
  [[nodiscard]] bool list(std::vector<CameraInfo>& cameras, std::string& why) override;

 private:
  Result<ArvCamera*> open_address(const std::string& address, std::string& why);
  Result<ArvCamera*> open_serial(const std::string& serial, std::string& why);

  const Functions* arv_ = nullptr;
  std::vector<std::unique_ptr<SystemDevice>> open_;
};

/// Straight to the address: the library's own way goes by a search of all networks.
Result<ArvCamera*> SystemLibrary::open_address(const std::string& address, std::string& why) {
  const std::string own = own_address_towards(address);
  if (own.empty()) {
    why = "no network leads to " + address;
    return Unexpected(Error::kDisconnected);
  }
  GInetAddress* const here = arv_->g_inet_address_new_from_string(own.c_str());
  GInetAddress* const there = arv_->g_inet_address_new_from_string(address.c_str());
  Refusal refusal(*arv_);
  ArvDevice* const device = arv_->arv_gv_device_new(here, there, refusal.out());
  arv_->g_object_unref(here);
  arv_->g_object_unref(there);
  if (device == nullptr || refusal.said()) {
    why = "does not answer";
    std::string words;
    why += refusal.said(words) ? ": " + words : std::string();
    if (device != nullptr) {
      arv_->g_object_unref(device);
    }
    return Unexpected(Error::kDisconnected);
  }
  if (arv_->arv_gv_device_is_controller(reinterpret_cast<ArvGvDevice*>(device)) == FALSE) {
    arv_->g_object_unref(device);
    why = "is busy: another program has its control, expected it free";
    return Unexpected(Error::kIo);
  }
  ArvCamera* const camera = arv_->arv_camera_new_with_device(device, refusal.out());
  arv_->g_object_unref(device);  // the camera holds it
  if (camera == nullptr) {
    why = "cannot be used";
    static_cast<void>(refusal.said(why));
    return Unexpected(Error::kIo);
  }
  return camera;
}

Result<ArvCamera*> SystemLibrary::open_serial(const std::string& serial, std::string& why) {
  std::vector<CameraInfo> cameras;
  if (!list(cameras, why)) {
    return Unexpected(Error::kUnsupported);
  }
  const auto chosen = choose_by_serial(cameras, serial, why);
  if (!chosen) {
    return Unexpected(chosen.error());
  }
  const std::string id = text_of(arv_->arv_get_device_id(static_cast<unsigned>(*chosen)));
  Refusal refusal(*arv_);
  ArvCamera* const camera = arv_->arv_camera_new(id.c_str(), refusal.out());
  if (camera == nullptr) {
    why = "does not answer";
    static_cast<void>(refusal.said(why));
    return Unexpected(Error::kDisconnected);
  }
  if (arv_->arv_camera_is_gv_device(camera) != FALSE &&
      arv_->arv_gv_device_is_controller(
          reinterpret_cast<ArvGvDevice*>(arv_->arv_camera_get_device(camera))) == FALSE) {
    arv_->g_object_unref(camera);
    why = "is busy: another program has its control, expected it free";
    return Unexpected(Error::kIo);
  }
  return camera;
}

Result<Device*> SystemLibrary::open(const std::string& device, std::string& why) {
  arv_ = load_functions(why);
  if (arv_ == nullptr) {
    return Unexpected(Error::kUnsupported);
  }
  const bool by_address = device.starts_with(kAddress);
  const auto camera = by_address ? open_address(device.substr(kAddress.size()), why)
                                 : open_serial(device.substr(kSerial.size()), why);
  if (!camera) {
    return Unexpected(camera.error());
  }
  open_.push_back(std::make_unique<SystemDevice>(*arv_, *camera));
  return open_.back().get();
}

void SystemLibrary::close(Device& device) {
  std::erase_if(open_, [&](const auto& ours) { return ours.get() == &device; });
}

bool SystemLibrary::list(std::vector<CameraInfo>& cameras, std::string& why) {
  arv_ = load_functions(why);
  if (arv_ == nullptr) {
    return false;
  }
  arv_->arv_update_device_list();
  for (unsigned i = 0; i < arv_->arv_get_n_devices(); ++i) {
    cameras.push_back(
        {text_of(arv_->arv_get_device_serial_nbr(i)), text_of(arv_->arv_get_device_address(i)),
         text_of(arv_->arv_get_device_vendor(i)) + " " + text_of(arv_->arv_get_device_model(i)),
         text_of(arv_->arv_get_device_protocol(i))});
  }
  return true;
}

}  // namespace

Library& system_library() {
  static SystemLibrary library;
  return library;
}

}  // namespace tubesight::drivers::aravis
