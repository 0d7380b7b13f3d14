#pragma once

#include <string>
#include <utility>

namespace tubesight::drivers {

/// Which camera it is, as far as it says it; what it does not say is empty.
struct CameraIdentity {
  std::string serial;
  std::string model;  ///< maker and model, or the driver and what it calls the camera
};

/// Sees to it that a camera is the calibrated one, and that it stays the one that it was.
///
/// What the calibration says is compared: its serial number, and its model. Whatever it says, the
/// camera that was used first is kept: another one in its place is not taken before the box is
/// started anew by somebody, who knows.
class IdentityWatch {
 public:
  explicit IdentityWatch(CameraIdentity calibrated) : calibrated_(std::move(calibrated)) {}

  /// What is wrong with a camera, to stand behind its name; empty: it may be used.
  [[nodiscard]] std::string refusal(const CameraIdentity& found) const;
  /// It is used from now on.
  void keep(const CameraIdentity& found);

  /// What the calibration leaves open of the camera that is used, though that could be told; empty:
  /// nothing, or none is used.
  [[nodiscard]] std::string doubt() const;

 private:
  CameraIdentity calibrated_;
  CameraIdentity kept_;
  bool used_ = false;  ///< `kept_` is
};

}  // namespace tubesight::drivers
