#include "drivers/simulated/simulated_robot_link.h"

#include "hal/dimmer.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Event;
using core::Result;
using core::Unexpected;

/// What a controller may send at all; a real line's decoder refuses the rest.
bool sound(const Event& event) {
  if (const auto* const lamp = core::content_if<core::LampCommand>(event)) {
    return lamp->permille >= 0 && lamp->permille <= hal::kFullLevel_permille;
  }
  return core::content_if<core::Claim>(event) != nullptr ||
         core::content_if<core::Start>(event) != nullptr ||
         core::content_if<core::Pick>(event) != nullptr ||
         core::content_if<core::PoseRequest>(event) != nullptr;
}

}  // namespace

Result<void> SimulatedRobotLink::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  forget_messages();
  started_ = true;
  return {};
}

void SimulatedRobotLink::stop() {
  if (started_) {
    forget_messages();
  }
  started_ = false;
}

Result<void> SimulatedRobotLink::usable() {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  if (!connected_) {
    forget_messages();
    return Unexpected(Error::kDisconnected);
  }
  return {};
}

SimulatedRobotLink::Fate SimulatedRobotLink::fate() {
  const double share = dice_.share();
  if (share < noise_.lost) {
    return Fate::kLost;
  }
  return share < noise_.lost + noise_.garbled ? Fate::kGarbled : Fate::kArrives;
}

void SimulatedRobotLink::forget_messages() {
  while (robot_->take_message()) {
  }
}

Result<std::optional<Event>> SimulatedRobotLink::poll_event() {
  if (const auto ready = usable(); !ready) {
    return Unexpected(ready.error());
  }
  while (const auto message = robot_->take_message()) {
    const Fate what = fate();
    if (what == Fate::kGarbled || (what == Fate::kArrives && !sound(*message))) {
      return Unexpected(Error::kDataLoss);
    }
    if (what == Fate::kArrives) {
      return std::optional<Event>(*message);
    }
  }
  return std::optional<Event>();
}

Result<void> SimulatedRobotLink::send_reply(const core::Reply& reply) {
  TUBESIGHT_TRY(usable());
  if (fate() == Fate::kArrives) {
    robot_->hear(reply);
  }
  return {};
}

Result<void> SimulatedRobotLink::send_sighting(const core::Sighting& sighting) {
  TUBESIGHT_TRY(usable());
  if (fate() == Fate::kArrives) {
    robot_->hear(sighting);
  }
  return {};
}

}  // namespace tubesight::drivers
