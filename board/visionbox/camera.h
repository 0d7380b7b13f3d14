#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/field.h"
#include "hal/frame_grabber.h"

namespace tubesight::board {

/// How a camera is doing, for whoever asks; of whatever driver.
struct CameraStatus {
  bool well = false;
  std::string words;    ///< "well", "no signal"
  bool counts = false;  ///< fields are numbered by the camera
  bool stamps = false;  ///< times are the camera's own
  std::string doubt;    ///< what the calibration leaves open of it; empty: nothing, or none is open
  /// What was counted, by the names of docs/cameras.md.
  std::vector<std::pair<const char*, std::int64_t>> counters;
};

/// A camera as a source needs it: its grabber, and what drivers of cameras say beside fields.
class Camera {
 public:
  virtual ~Camera() = default;

  /// start() and stop() may take their time.
  [[nodiscard]] virtual hal::FrameGrabber& grabber() = 0;
  /// What a camera must be asked beside its fields; some times a second, of the thread that starts
  /// it.
  virtual void look_after() = 0;
  /// What was wrong at the last start.
  [[nodiscard]] virtual std::string message() const = 0;
  /// What the calibration leaves open of the camera that was opened last; of the thread that
  /// starts it.
  [[nodiscard]] virtual std::string doubt() const = 0;
  /// From one field to the next, and fields that come at once; valid once started.
  [[nodiscard]] virtual core::FieldTime span() const = 0;
  [[nodiscard]] virtual std::int32_t fields_at_once() const = 0;
  /// But for its doubt. Any thread.
  [[nodiscard]] virtual CameraStatus status() const = 0;
};

}  // namespace tubesight::board
