#include "drivers/aravis/camera_choice.h"

namespace tubesight::drivers::aravis {

using core::Error;
using core::Result;
using core::Unexpected;

Result<std::size_t> choose_by_serial(const std::vector<CameraInfo>& cameras,
                                     const std::string& serial, std::string& why) {
  std::string there;
  std::string alike;
  std::size_t chosen = cameras.size();
  std::size_t found = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const CameraInfo& camera = cameras[i];
    there += (there.empty() ? "serial:" : ", serial:") + camera.serial;
    if (camera.serial == serial) {
      chosen = i;
      ++found;
      alike += (alike.empty() ? "" : ", ") + camera.maker_and_model + " at " + camera.address;
    }
  }
  if (found == 0) {
    why = "is not there, expected one of: " + (there.empty() ? "no camera answers" : there);
    return Unexpected(Error::kDisconnected);
  }
  if (found > 1) {
    why = "is there more than once (" + alike + "), expected one: name it by its address";
    return Unexpected(Error::kUnsupported);
  }
  return chosen;
}

}  // namespace tubesight::drivers::aravis
