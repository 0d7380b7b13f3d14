#pragma once

#include <string>

#include "core/base/result.h"
#include "drivers/camera/camera_identity.h"
#include "drivers/v4l2/buffer_ring.h"
#include "drivers/v4l2/camera_setup.h"
#include "drivers/v4l2/kernel.h"
#include "drivers/v4l2/picture_controls.h"
#include "drivers/v4l2/signal.h"
#include "drivers/v4l2/v4l2_settings.h"
#include "drivers/v4l2/video_standard.h"
#include "hal/clock.h"

namespace tubesight::drivers::v4l2 {

/// A camera that streams: found, checked, set as wanted, its buffers with the driver.
class CameraDevice {
 public:
  /// `settings`, `kernel` and `clock` outlive it.
  CameraDevice(const V4l2Settings& settings, Kernel& kernel, const hal::Clock& clock)
      : settings_(settings),
        kernel_(&kernel),
        question_(kernel, clock),
        identity_(settings.calibrated),
        picture_(kernel),
        ring_(kernel) {}
  CameraDevice(const CameraDevice&) = delete;
  CameraDevice& operator=(const CameraDevice&) = delete;
  ~CameraDevice() { close(); }

  /// Opens the device wherever it is now, and starts the stream. After an error it is closed.
  /// Errors: kDisconnected it is not there; kUnsupported it is no camera, another than was
  /// calibrated, or without what is wanted; kIo it refused. `message` says it in one line.
  [[nodiscard]] core::Result<void> open(std::string& message);
  void close();

  /// Whether another program has chosen another input: pictures are another camera's.
  [[nodiscard]] bool switched();

  /// Whether another program has changed a control that moves the picture. May take its time.
  [[nodiscard]] bool altered() const { return picture_.changed(descriptor_); }

  /// What the driver says of the signal that comes in. May take its time.
  [[nodiscard]] Signal signal();

  /// What the calibration leaves open of the camera.
  [[nodiscard]] std::string doubt() const { return identity_.doubt(); }

  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] const AgreedFormat& agreed() const { return agreed_; }
  [[nodiscard]] BufferRing& ring() { return ring_; }

 private:
  core::Result<void> open_all(std::string& message);
  core::Result<void> find(std::string& node, std::string& message);
  core::Result<void> keep_input(std::string& message);
  core::Result<void> check(const std::string& node, std::string& message);
  Signal signal_of_input();

  const V4l2Settings& settings_;
  Kernel* kernel_;
  int descriptor_ = -1;
  AgreedFormat agreed_;
  StandardQuestion question_;
  Signal signal_ = Signal::kGood;  ///< as it was last told
  int input_ = -1;                 ///< chosen at the first start; -1: none was
  IdentityWatch identity_;
  CameraIdentity found_;  ///< of the device that is open
  PictureControls picture_;
  BufferRing ring_;
};

}  // namespace tubesight::drivers::v4l2
