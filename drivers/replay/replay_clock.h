#pragma once

#include "drivers/replay/replay_frame_grabber.h"
#include "hal/clock.h"

namespace tubesight::drivers {

/// The clock that stamped a recording: stands still between fields.
class ReplayClock final : public hal::Clock {
 public:
  /// `grabber` outlives the clock.
  explicit ReplayClock(const ReplayFrameGrabber& grabber) : grabber_(&grabber) {}

  [[nodiscard]] core::FieldTime now() const override { return grabber_->field_time(); }

 private:
  const ReplayFrameGrabber* grabber_;
};

}  // namespace tubesight::drivers
