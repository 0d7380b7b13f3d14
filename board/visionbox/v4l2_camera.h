#pragma once

#include "board/visionbox/camera.h"
#include "drivers/v4l2/v4l2_frame_grabber.h"

namespace tubesight::board {

/// A camera behind V4L2.
class V4l2Camera final : public Camera {
 public:
  /// As V4l2FrameGrabber's.
  V4l2Camera(const drivers::V4l2Settings& settings, const hal::Clock& clock)
      : grabber_(settings, clock) {}

  [[nodiscard]] hal::FrameGrabber& grabber() override { return grabber_; }
  void look_after() override { grabber_.look_after(); }
  [[nodiscard]] std::string message() const override;
  [[nodiscard]] std::string doubt() const override { return grabber_.doubt(); }
  [[nodiscard]] core::FieldTime span() const override { return grabber_.span(); }
  [[nodiscard]] std::int32_t fields_at_once() const override { return grabber_.fields_a_buffer(); }
  [[nodiscard]] CameraStatus status() const override;

 private:
  drivers::V4l2FrameGrabber grabber_;
};

/// What a V4L2 driver's report says, in words and by names.
[[nodiscard]] CameraStatus status_of(const drivers::CameraReport& report);

}  // namespace tubesight::board
