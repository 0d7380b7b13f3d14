#include "board/bench/event_feed.h"

namespace tubesight::board {

EventFeed::EventFeed(const core::StartSettings& start) {
  core::Event event;
  event.origin = core::EventOrigin::kOperator;
  event.content = core::Start{start.tubes, {}, false};
  waiting_.push_back(event);
}

void EventFeed::take_before(std::int64_t field, drivers::ReplayEvents& recorded,
                            core::EventList& events) {
  recorded.take_before(field, events);
  if (waiting_.empty()) {
    return;
  }
  waiting_.insert(waiting_.end(), events.begin(), events.end());
  events.clear();
  std::size_t handed = 0;
  while (handed < waiting_.size() && events.try_push_back(waiting_[handed])) {
    ++handed;
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(handed));
}

}  // namespace tubesight::board
