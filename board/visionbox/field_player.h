#pragma once

#include <cstdint>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/result.h"
#include "drivers/files/messages.h"

namespace tubesight::board {

/// A field and what was said before it, by whoever is written down beforehand.
struct PlayedField {
  core::Field field;  ///< on the player's own time and numbers; pixels valid until the next call
  core::EventList events;
};

/// What plays in the place of a camera: a recording or a scenario, as fast as it is asked.
///
/// The thread of the source calls all functions; they may read files, allocate and take their time.
class FieldPlayer {
 public:
  virtual ~FieldPlayer() = default;

  /// Goes to the beginning. Errors: those of the recording or scenario, with lines for a person in
  /// `messages`.
  [[nodiscard]] virtual core::Result<void> start(drivers::Messages& messages) = 0;
  virtual void stop() = 0;

  /// The next field, exposed with the lamp at this level where the lamp is the player's. Errors:
  /// kEndOfData there is none; others as hal::FrameGrabber, with `messages`.
  [[nodiscard]] virtual core::Result<void> next(std::int32_t lamp_permille, PlayedField& out,
                                                drivers::Messages& messages) = 0;

  /// From one field to the next; valid once started.
  [[nodiscard]] virtual core::FieldTime span() const = 0;

  /// Whether a dimmer has a lamp to act on.
  [[nodiscard]] virtual bool has_lamp() const = 0;

  /// Fields that may be made before their time. What reacts to the box is not played ahead.
  [[nodiscard]] virtual std::int32_t fields_ahead() const = 0;
};

}  // namespace tubesight::board
