#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include <gtest/gtest.h>

#include "drivers/v4l2/v4l2_frame_grabber.h"
#include "tests/drivers/v4l2/fake_kernel.h"

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
class CameraBench {
 public:
  explicit CameraBench(const drivers::V4l2Settings& settings = settings_of())
      : grabber_(settings, kernel_, kernel_) {
    kernel_.link(kByPath, "/dev/video0");
  }

  drivers::V4l2FrameGrabber& grabber() { return grabber_; }
  FakeKernel& kernel() { return kernel_; }
  FakeCamera& camera() { return *camera_; }
  const std::shared_ptr<FakeCamera>& shared_camera() { return camera_; }

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

  /// What whoever keeps the camera does after an error.
  core::Result<void> start_anew() {
    grabber_.stop();
    return grabber_.start();
  }

  [[nodiscard]] drivers::CameraReport report() const { return grabber_.report(); }
  [[nodiscard]] drivers::CameraCounters counters() const { return grabber_.report().counters; }
  [[nodiscard]] std::string message() const {
    return grabber_.messages().empty() ? std::string() : grabber_.messages().front();
  }

 private:
  FakeKernel kernel_;
  std::shared_ptr<FakeCamera> camera_ = kernel_.plug(0, std::make_shared<FakeCamera>());
  drivers::V4l2FrameGrabber grabber_;
};

/// Whether each pixel is the one that the camera drew there.
inline void expect_drawn(const core::Field& field, std::int32_t width_px, std::int32_t lines) {
  const core::FieldView& view = field.pixels;
  ASSERT_EQ(view.width_px, width_px);
  ASSERT_EQ(view.lines, lines);
  for (std::int32_t line = 0; line < lines; ++line) {
    const std::uint8_t* const pixels =
        view.pixels + static_cast<std::ptrdiff_t>(line) * view.stride_px;
    const std::int32_t v = view.first_line + line * view.line_step;
    std::int32_t alike = 0;
    while (alike < width_px && pixels[alike] == drawn_grey(alike, v)) {
      ++alike;
    }
    ASSERT_EQ(alike, width_px) << "line " << line;
  }
}

}  // namespace tubesight::tests
