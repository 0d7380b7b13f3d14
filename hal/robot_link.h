#pragma once

#include <optional>

#include "core/base/event.h"
#include "core/base/reply.h"
#include "core/base/result.h"
#include "core/base/sighting.h"

namespace tubesight::hal {

/// The line to the robot's controller: it asks, the box answers.
///
/// The robot sends claims, starts, picks, lamp commands and pose requests. A message is either
/// delivered whole and unchanged or not at all; what the line garbles is found by the driver,
/// dropped, and reported. Nothing is sent twice by the link: who gets no reply asks again. One
/// thread calls all functions.
class RobotLink {
 public:
  /// Opens the line. A robot need not be there yet. Needs: not started. After an error the link is
  /// as before and start() may be tried again.
  ///
  /// Errors: kIo the line cannot be opened, kNotReady already started.
  [[nodiscard]] virtual core::Result<void> start() = 0;

  /// Closes the line; messages that were not taken are forgotten. Calling it when not started does
  /// nothing.
  virtual void stop() = 0;

  /// Takes the next message of the robot, in the order of their arrival; empty: none has come.
  ///
  /// Never waits. Kinds: Claim, Start, Pick, LampCommand, PoseRequest; others never come. A start
  /// has at most core::kMaxStartPoints tubes, a lamp command is within 0..1000, as the driver
  /// checks. The lower 32 bits of an event's id are the robot's own number; above them a link may
  /// count, so that the answer to one event is never taken for that to another of the same number.
  ///
  /// Errors: kDataLoss a message came garbled and was dropped, or so many waited that one was: call
  /// again, the next may be sound; kDisconnected the robot is gone (the link stays started and
  /// delivers again when it is back); kIo the line failed; kNotReady not started.
  [[nodiscard]] virtual core::Result<std::optional<core::Event>> poll_event() = 0;

  /// Sends the answer to one event of the robot, with the event's id and what was claimed, so that
  /// a robot of whose messages one was lost does not take the answer for that to another.
  ///
  /// Hands the message to the line and does not wait for it to be sent. Pose results answer the
  /// request that they belong to. Errors, after which nothing of the message was sent:
  /// kBufferTooSmall the line is slower than the answers, kDisconnected the robot is gone, kIo the
  /// line failed, kNotReady not started.
  [[nodiscard]] virtual core::Result<void> send_reply(const core::Reply& reply) = 0;

  /// Sends what the box sees, unasked. One that the line has no room for is left out without an
  /// error, as the next replaces it. Errors: kDisconnected, kIo, kNotReady as send_reply().
  [[nodiscard]] virtual core::Result<void> send_sighting(const core::Sighting& sighting) = 0;

 protected:
  ~RobotLink() = default;
};

}  // namespace tubesight::hal
