#pragma once

#include <memory>

#include "drivers/aravis/aravis_frame_grabber.h"
#include "tests/drivers/aravis/fake_library.h"
#include "tests/support/grabber_bench.h"

namespace tubesight::tests {

/// Settings of a camera that bench cameras are.
inline drivers::AravisSettings gige_settings(core::Scan scan = core::Scan::kProgressive) {
  drivers::AravisSettings settings;
  settings.device = "address:10.0.0.2";
  settings.width_px = 64;
  settings.height_px = 48;
  settings.scan = scan;
  return settings;
}

/// A grabber on a fake library with one camera, at 30 pictures a second.
class GigeBench : public GrabberBench<drivers::AravisFrameGrabber, FakeLibrary> {
 public:
  explicit GigeBench(const drivers::AravisSettings& settings = gige_settings())
      : GrabberBench(settings) {}

  FakeLibrary& library() { return fake(); }
  FakeGigeCamera& camera() { return *camera_; }

  /// Starts, and takes the fields that are not believed yet.
  bool settle() { return grabber().start() && good_within(8); }

 private:
  std::shared_ptr<FakeGigeCamera> camera_ = fake().plug(std::make_shared<FakeGigeCamera>());
};

}  // namespace tubesight::tests
