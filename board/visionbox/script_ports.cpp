#include "board/visionbox/script_ports.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Event;
using core::Result;
using core::Unexpected;

/// The script's next row when it is of this origin: rows keep their order, whoever says them.
std::optional<Event> take_row(PlayedSource& source, core::EventOrigin origin) {
  const Event* const next = source.next_said();
  if (next == nullptr || next->origin != origin) {
    return {};
  }
  const Event event = *next;
  source.take_said();
  return event;
}

}  // namespace

Result<void> ScriptedLink::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  started_ = true;
  return {};
}

Result<std::optional<Event>> ScriptedLink::poll_event() {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  return take_row(*source_, core::EventOrigin::kRobot);
}

Result<void> ScriptedLink::send_reply(const core::Reply& /*reply*/) {
  return started_ ? Result<void>() : Unexpected(Error::kNotReady);
}

Result<void> ScriptedLink::send_sighting(const core::Sighting& /*sighting*/) {
  return started_ ? Result<void>() : Unexpected(Error::kNotReady);
}

Result<std::optional<Event>> ScriptedStation::poll_event() {
  while (!scripted_link_ && take_row(*source_, core::EventOrigin::kRobot)) {
  }
  if (const auto row = take_row(*source_, core::EventOrigin::kOperator)) {
    return std::optional<Event>(row);
  }
  return station_->poll_event();
}

Result<void> ScriptedStation::send_reply(const core::Reply& reply) {
  return reply.id >= kFirstStationId ? station_->send_reply(reply) : Result<void>();
}

}  // namespace tubesight::board
