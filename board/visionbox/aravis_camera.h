#pragma once

#include <string>

#include "board/visionbox/camera.h"
#include "drivers/aravis/aravis_frame_grabber.h"

namespace tubesight::board {

/// A camera of GigE Vision or USB3 Vision.
class AravisCamera final : public Camera {
 public:
  /// As AravisFrameGrabber's.
  AravisCamera(const drivers::AravisSettings& settings, const hal::Clock& clock,
               drivers::aravis::Library& library = drivers::aravis::system_library())
      : grabber_(settings, clock, library) {}

  [[nodiscard]] hal::FrameGrabber& grabber() override { return grabber_; }
  void look_after() override { grabber_.look_after(); }
  [[nodiscard]] std::string message() const override;
  [[nodiscard]] std::string doubt() const override { return grabber_.doubt(); }
  [[nodiscard]] core::FieldTime span() const override { return grabber_.span(); }
  [[nodiscard]] std::int32_t fields_at_once() const override { return grabber_.fields_a_picture(); }
  [[nodiscard]] CameraStatus status() const override;

 private:
  drivers::AravisFrameGrabber grabber_;
};

/// What the driver's report says, in words and by names.
[[nodiscard]] CameraStatus status_of(const drivers::AravisReport& report);

}  // namespace tubesight::board
