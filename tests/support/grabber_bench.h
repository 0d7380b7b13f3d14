#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "core/base/field.h"
#include "core/base/result.h"
#include "hal/frame_grabber.h"
#include "tests/support/drawn_grey.h"

namespace tubesight::tests {

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

/// A camera's grabber on what stands in for the system or library below it, which is also its
/// clock.
template <typename Grabber, typename Fake>
class GrabberBench {
 public:
  template <typename Settings>
  explicit GrabberBench(const Settings& settings) : grabber_(settings, fake_, fake_) {}

  Grabber& grabber() { return grabber_; }

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

  [[nodiscard]] auto report() const { return grabber_.report(); }
  [[nodiscard]] auto counters() const { return grabber_.report().counters; }
  [[nodiscard]] std::string message() const {
    return grabber_.messages().empty() ? std::string() : grabber_.messages().front();
  }

 protected:
  Fake& fake() { return fake_; }

 private:
  Fake fake_;
  Grabber grabber_;
};

}  // namespace tubesight::tests
