#include "drivers/control/socket_station.h"

namespace tubesight::drivers {

using core::Error;
using core::Result;
using core::Unexpected;

Result<void> SocketStation::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  started_ = true;
  return {};
}

void SocketStation::stop() {
  started_ = false;
  core::Event forgotten;
  while (events_.try_pop(forgotten)) {
  }
  dropped_ = false;
}

Result<std::optional<core::Event>> SocketStation::poll_event() {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  if (dropped_.exchange(false)) {
    return Unexpected(Error::kDataLoss);
  }
  core::Event event;
  return events_.try_pop(event) ? std::optional<core::Event>(event) : std::optional<core::Event>();
}

Result<void> SocketStation::send_reply(const core::Reply& reply) {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  return replies_.try_push(reply) ? Result<void>() : Unexpected(Error::kBufferTooSmall);
}

Result<void> SocketStation::show(const core::RgbImageView& /*picture*/,
                                 const core::Sighting& /*sighting*/) {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  ++pictures_;
  return {};
}

bool SocketStation::submit(const core::Event& event) {
  if (!started_) {
    return false;
  }
  if (events_.try_push(event)) {
    return true;
  }
  dropped_ = true;
  return false;
}

std::optional<core::Reply> SocketStation::take_reply() {
  core::Reply reply;
  return replies_.try_pop(reply) ? std::optional<core::Reply>(reply) : std::optional<core::Reply>();
}

}  // namespace tubesight::drivers
