#include "drivers/simulated/simulated_dimmer.h"

namespace tubesight::drivers {

using core::Error;
using core::Result;
using core::Unexpected;

Result<void> SimulatedDimmer::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  if (failure_) {
    return Unexpected(Error::kIo);
  }
  started_ = true;
  world_->set_lamp_permille(0);
  return {};
}

void SimulatedDimmer::stop() {
  if (started_ && !failure_) {
    world_->set_lamp_permille(0);
  }
  started_ = false;
  level_permille_ = 0;
}

Result<void> SimulatedDimmer::set_level(std::int32_t permille) {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  if (permille < 0 || permille > hal::kFullLevel_permille) {
    return Unexpected(Error::kOutOfRange);
  }
  if (failure_) {
    return Unexpected(*failure_);
  }
  world_->set_lamp_permille(permille);
  level_permille_ = permille;
  return {};
}

}  // namespace tubesight::drivers
