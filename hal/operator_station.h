#pragma once

#include <optional>

#include "core/base/event.h"
#include "core/base/image_view.h"
#include "core/base/reply.h"
#include "core/base/result.h"
#include "core/base/sighting.h"

namespace tubesight::hal {

/// Where a person sees what the box sees, names tubes by clicks, and reads the answers.
///
/// A station may be there without anybody in front of it; that is no error. One thread calls all
/// functions but show(), which may have another thread of its own.
class OperatorStation {
 public:
  /// Opens the station. Needs: not started. After an error the station is as before and start() may
  /// be tried again.
  ///
  /// Errors: kIo it cannot be opened, kNotReady already started.
  [[nodiscard]] virtual core::Result<void> start() = 0;

  /// Closes the station; events that were not taken are forgotten. Calling it when not started does
  /// nothing.
  virtual void stop() = 0;

  /// Takes the next thing that the operator did, in order; empty: nothing.
  ///
  /// Never waits. Kinds: Start, Pick, Acknowledge, LampCommand, all of origin kOperator; others
  /// never come. A start has at most core::kMaxStartPoints tubes, a lamp command is within 0..1000,
  /// as the driver checks.
  ///
  /// Errors: kDataLoss so much waited that something was dropped: call again; kDisconnected,
  /// kIo the station is gone or failed (it stays started and delivers again when it is back);
  /// kNotReady not started.
  [[nodiscard]] virtual core::Result<std::optional<core::Event>> poll_event() = 0;

  /// Hands over the answer to one event of the operator; does not wait for it to be seen.
  ///
  /// Errors, after which nothing of the answer is shown: kBufferTooSmall the station is slower than
  /// the answers, kDisconnected, kIo, kNotReady as poll_event().
  [[nodiscard]] virtual core::Result<void> send_reply(const core::Reply& reply) = 0;

  /// Shows a picture with its marks drawn in, and what the box says to it. The picture is read
  /// before the call returns; nobody waits until it is seen, and one that the station has no room
  /// for is left out without an error, as the next replaces it.
  ///
  /// Errors: kIo the station failed, kDisconnected it is gone, kNotReady not started.
  [[nodiscard]] virtual core::Result<void> show(const core::RgbImageView& picture,
                                                const core::Sighting& sighting) = 0;

 protected:
  ~OperatorStation() = default;
};

}  // namespace tubesight::hal
