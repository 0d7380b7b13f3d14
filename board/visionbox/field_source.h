#pragma once

#include <cstdint>

#include "board/visionbox/source_clock.h"
#include "core/base/field.h"
#include "hal/clock.h"
#include "hal/frame_grabber.h"

namespace tubesight::board {

/// How a source is doing.
enum class SourceState : std::uint8_t {
  kOpening,  ///< it has delivered nothing yet
  kPlaying,
  kEnded,   ///< it came to its end and is not played again
  kFailed,  ///< it will be opened again after a while
};

/// What the box watches: fields at their own pace, from a camera or from what stands in its place.
///
/// Opening, and opening again whatever ended or failed, is the business of a thread of the
/// source's; grab_for() and give_back() belong to the tracking thread and allocate nothing.
/// kDisconnected: there is no field to wait for now; the source is asked again as after a time-out.
class FieldSource : public hal::FrameGrabber {
 public:
  /// The clock of the fields.
  [[nodiscard]] virtual const hal::Clock& clock() const = 0;

  [[nodiscard]] virtual SourceState state() const = 0;
  /// From one field to the next; a guess before the source was opened.
  [[nodiscard]] virtual core::FieldTime span() const = 0;
  /// Fields that come at once: 2 where a camera gives both of a frame together.
  [[nodiscard]] virtual std::int32_t fields_at_once() const = 0;
  /// Times that it was opened, and times that it failed.
  [[nodiscard]] virtual std::int64_t passes() const = 0;
  [[nodiscard]] virtual std::int64_t failures() const = 0;
  /// Fields that it made itself, and later than it should; a camera makes none.
  [[nodiscard]] virtual std::int64_t made_late() const = 0;

  /// When the last field was due, and when it was handed over. Of the tracking thread.
  [[nodiscard]] virtual MonotonicTime due() const = 0;
  [[nodiscard]] virtual MonotonicTime handed_over() const = 0;

 protected:
  ~FieldSource() = default;
};

}  // namespace tubesight::board
