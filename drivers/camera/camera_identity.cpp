#include "drivers/camera/camera_identity.h"

namespace tubesight::drivers {
namespace {

constexpr const char* kCalibrated = ", the one that was calibrated";
constexpr const char* kUsedBefore = ", the one that this box has used so far";

std::string serial_mismatch(const std::string& expected, const std::string& found,
                            const char* which) {
  if (expected.empty() || expected == found) {
    return {};
  }
  return (found.empty() ? "says no serial number" : "has the serial number " + found) +
         ", expected " + expected + which;
}

std::string model_mismatch(const std::string& expected, const std::string& found,
                           const char* which) {
  if (expected.empty() || expected == found) {
    return {};
  }
  return (found.empty() ? "says no model" : "is '" + found + "'") + ", expected '" + expected +
         "'" + which;
}

std::string mismatch(const CameraIdentity& expected, const CameraIdentity& found,
                     const char* which) {
  const std::string serial = serial_mismatch(expected.serial, found.serial, which);
  return serial.empty() ? model_mismatch(expected.model, found.model, which) : serial;
}

}  // namespace

std::string IdentityWatch::refusal(const CameraIdentity& found) const {
  const std::string wrong = mismatch(calibrated_, found, kCalibrated);
  if (!wrong.empty() || !used_) {
    return wrong;
  }
  // One that has no number and now says one is another as well.
  if (kept_.serial.empty() && !found.serial.empty()) {
    return "has the serial number " + found.serial + ", expected one without" + kUsedBefore;
  }
  return mismatch(kept_, found, kUsedBefore);
}

void IdentityWatch::keep(const CameraIdentity& found) {
  kept_ = found;
  used_ = true;
}

std::string IdentityWatch::doubt() const {
  const bool serial = calibrated_.serial.empty() && !kept_.serial.empty();
  const bool model = calibrated_.model.empty() && !kept_.model.empty();
  if (!used_ || !calibrated_.serial.empty() || (!serial && !model)) {
    return {};
  }
  std::string text = calibrated_.model.empty()
                         ? "calibration is bound to no camera: this one is"
                         : "calibration is bound to a model and to no camera of it: this one is";
  text += serial ? " serial = \"" + kept_.serial + "\"" : "";
  text += serial && model ? "," : "";
  return text + (model ? " model = \"" + kept_.model + "\"" : "");
}

}  // namespace tubesight::drivers
