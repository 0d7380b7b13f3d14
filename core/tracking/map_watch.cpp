#include "core/tracking/map_watch.h"

#include <algorithm>

namespace tubesight::core::tracking {

MapWatch::Entry* MapWatch::find(TubeAddress address) {
  auto* const found = std::find_if(entries_.begin(), entries_.end(), [address](const Entry& entry) {
    return entry.score > 0 && entry.address == address;
  });
  return found == entries_.end() ? nullptr : found;
}

void MapWatch::see(const SiteSightings& sites) {
  for (const TubeAddress address : sites.open) {
    Entry* entry = find(address);
    if (entry == nullptr) {
      entry = std::find_if(entries_.begin(), entries_.end(),
                           [](const Entry& each) { return each.score == 0; });
      if (entry == entries_.end()) {
        continue;  // as many as are open by now are more than enough
      }
      *entry = {address, 0};
    }
    entry->score = static_cast<std::int8_t>(std::min<int>(entry->score + 1, kMost));
  }
  for (const TubeAddress address : sites.closed) {
    if (Entry* const entry = find(address)) {
      --entry->score;
    }
  }
}

bool MapWatch::asks() {
  fields_ = (fields_ + 1) % kAskEvery;
  return fields_ == 0;
}

bool MapWatch::refuted() const {
  return for_others_ >= kAnswers ||
         std::count_if(entries_.begin(), entries_.end(),
                       [](const Entry& entry) { return entry.score >= kOpen; }) >= kMostOpen;
}

}  // namespace tubesight::core::tracking
