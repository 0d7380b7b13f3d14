#include "drivers/simulated/simulated_frame_grabber.h"

#include <algorithm>

#include "core/base/assert.h"

namespace tubesight::drivers {

using core::Error;
using core::Result;
using core::Unexpected;

Result<void> SimulatedFrameGrabber::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  TUBESIGHT_TRY(world_->configure(*scenario_));
  latest_time_ = core::FieldTime(0);
  started_ = true;
  return {};
}

void SimulatedFrameGrabber::stop() {
  TUBESIGHT_ASSERT(!lent_);
  started_ = false;
}

Result<hal::FieldLease> SimulatedFrameGrabber::grab_for(std::chrono::milliseconds /*timeout*/) {
  if (!started_ || lent_) {
    return Unexpected(Error::kNotReady);
  }
  if (!world_->next(last_)) {
    return Unexpected(Error::kEndOfData);
  }
  ++delivered_;
  latest_time_ = std::max(latest_time_, last_.field.mid_exposure);
  lent_ = true;
  return hal::FieldLease(*this, 0, last_.field);
}

void SimulatedFrameGrabber::give_back(std::int32_t /*buffer*/) { lent_ = false; }

}  // namespace tubesight::drivers
