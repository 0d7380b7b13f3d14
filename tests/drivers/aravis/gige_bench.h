#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "drivers/aravis/aravis_frame_grabber.h"
#include "tests/drivers/aravis/fake_library.h"

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
class GigeBench {
 public:
  explicit GigeBench(const drivers::AravisSettings& settings = gige_settings())
      : grabber_(settings, library_, library_) {}

  drivers::AravisFrameGrabber& grabber() { return grabber_; }
  FakeLibrary& library() { return library_; }
  FakeGigeCamera& camera() { return *camera_; }

  core::Result<hal::FieldLease> grab(int timeout_ms = 100) {
    return grabber_.grab_for(std::chrono::milliseconds(timeout_ms));
  }
  /// The status of the next field; missing: none came.
  core::FieldStatus next_status() {
    const auto lease = grab();
    return lease ? lease->field().status : core::FieldStatus::kMissing;
  }
  /// Takes fields until one is good; false: none of so many is.
  bool good_within(int fields) {
    for (int i = 0; i < fields; ++i) {
      if (next_status() == core::FieldStatus::kGood) {
        return true;
      }
    }
    return false;
  }
  /// Starts, and takes the fields that are not believed yet.
  bool settle() { return grabber_.start() && good_within(8); }

  /// What whoever keeps the camera does after an error.
  core::Result<void> start_anew() {
    grabber_.stop();
    return grabber_.start();
  }

  [[nodiscard]] drivers::AravisReport report() const { return grabber_.report(); }
  [[nodiscard]] drivers::AravisCounters counters() const { return grabber_.report().counters; }
  [[nodiscard]] std::string message() const {
    return grabber_.messages().empty() ? std::string() : grabber_.messages().front();
  }

 private:
  FakeLibrary library_;
  std::shared_ptr<FakeGigeCamera> camera_ = library_.plug(std::make_shared<FakeGigeCamera>());
  drivers::AravisFrameGrabber grabber_;
};

}  // namespace tubesight::tests
