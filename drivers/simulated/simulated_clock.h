#pragma once

#include "drivers/simulated/simulated_frame_grabber.h"
#include "hal/clock.h"

namespace tubesight::drivers {

/// The clock of a simulated world: stands still between fields.
class SimulatedClock final : public hal::Clock {
 public:
  /// `grabber` outlives the clock.
  explicit SimulatedClock(const SimulatedFrameGrabber& grabber) : grabber_(&grabber) {}

  [[nodiscard]] core::FieldTime now() const override { return grabber_->latest_time(); }

 private:
  const SimulatedFrameGrabber* grabber_;
};

}  // namespace tubesight::drivers
