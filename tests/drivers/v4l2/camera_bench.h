#pragma once

#include <memory>

#include "drivers/v4l2/v4l2_frame_grabber.h"
#include "tests/drivers/v4l2/fake_kernel.h"
#include "tests/support/grabber_bench.h"

namespace tubesight::tests {

inline constexpr const char* kByPath = "/dev/v4l/by-path/pci-0-usb-0:1:1.0-video-index0";

/// Settings of a camera that bench cameras are.
inline drivers::V4l2Settings settings_of(core::Scan scan = core::Scan::kProgressive) {
  drivers::V4l2Settings settings;
  settings.device = kByPath;
  settings.width_px = 64;
  settings.height_px = 48;
  settings.scan = scan;
  return settings;
}

/// A grabber on a fake kernel with one camera, at 30 buffers a second.
class CameraBench : public GrabberBench<drivers::V4l2FrameGrabber, FakeKernel> {
 public:
  explicit CameraBench(const drivers::V4l2Settings& settings = settings_of())
      : GrabberBench(settings) {
    kernel().link(kByPath, "/dev/video0");
  }

  FakeKernel& kernel() { return fake(); }
  FakeCamera& camera() { return *camera_; }
  const std::shared_ptr<FakeCamera>& shared_camera() { return camera_; }

 private:
  std::shared_ptr<FakeCamera> camera_ = fake().plug(0, std::make_shared<FakeCamera>());
};

}  // namespace tubesight::tests
