#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "core/base/image_view.h"
#include "core/base/settings.h"
#include "tests/support/synthetic_sheet.h"

namespace tubesight::tests {

/// Where the tool is in a field of moving_recording(): from under tube (40, 60) on along the
/// columns, 150 mm/s at 60 fields a second.
inline ToolPlace moving_place(std::int64_t field) {
  return {60 * 25.4 + 0.4 + 2.5 * static_cast<double>(field), 40 * 25.4 - 0.3, 60.0, 2.0, 0.1, 0.1};
}

/// Frames of moving_recording(): 65 mm, over two tubes.
inline constexpr int kMovingFrames = 13;

/// A recording of that move by the camera of make_synthetic_settings(), both fields of a frame at
/// their own instants. Drawn once, in some seconds.
inline const std::string& moving_recording() {
  static const std::string text = [] {
    const auto settings = std::make_unique<core::SessionSettings>();
    make_synthetic_settings(*settings);
    const SyntheticSheet sheet(*settings);
    std::string drawn = "YUV4MPEG2 W635 H480 F30:1 It Cmono\n";
    Frame frame;
    for (int i = 0; i < kMovingFrames; ++i) {
      sheet.draw(moving_place(2 * i), core::Parity::kEven, 0, frame);
      sheet.draw(moving_place(2 * i + 1), core::Parity::kOdd, 0, frame);
      drawn += "FRAME\n";
      drawn.append(frame.begin(), frame.end());
    }
    return drawn;
  }();
  return text;
}

/// The same with nothing to be seen in frames `first` to `last`.
inline std::string darkened_recording(int first, int last) {
  constexpr std::size_t kFrame = 6 + 635 * 480;
  std::string text = moving_recording();
  const std::size_t header = text.find('\n') + 1;
  for (int i = first; i <= last; ++i) {
    const std::size_t pixels = header + static_cast<std::size_t>(i) * kFrame + 6;
    text.replace(pixels, kFrame - 6, kFrame - 6, '\x03');
  }
  return text;
}

}  // namespace tubesight::tests
