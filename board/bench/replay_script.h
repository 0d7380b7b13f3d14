#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/event.h"
#include "core/base/settings.h"
#include "drivers/replay/replay_events.h"

namespace tubesight::board {

/// Hands the events of a replay to the fields they belong before: the settings' start, then those
/// of the recording's event file.
class EventFeed {
 public:
  /// `[start]` of the settings becomes a start event before the first field.
  explicit EventFeed(const core::StartSettings& start);

  /// Replaces `events` by those before the field with this number. What does not fit is handed
  /// before the next field, in order. Call it for each field in turn.
  void take_before(std::int64_t field, drivers::ReplayEvents& recorded, core::EventList& events);

  /// Events that were due and not handed yet.
  [[nodiscard]] std::size_t left() const { return waiting_.size(); }

 private:
  std::vector<core::Event> waiting_;
};

}  // namespace tubesight::board
