#include "drivers/camera/camera_identity.h"

namespace tubesight::drivers {

std::string serial_mismatch(const std::string& calibrated, const std::string& found) {
  if (calibrated.empty() || calibrated == found) {
    return {};
  }
  return (found.empty() ? "says no serial number" : "has the serial number " + found) +
         ", expected " + calibrated + ", the one that was calibrated";
}

}  // namespace tubesight::drivers
