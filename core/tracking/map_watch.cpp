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
  for (Entry& entry : entries_) {
    if (entry.score > 0 && ++entry.unseen >= kRemembered) {
      entry = {};
    }
  }
  for (const TubeAddress address : sites.open) {
    Entry* entry = find(address);
    if (entry == nullptr) {
      // A free one, or the least that is known, and longest ago.
      entry =
          std::min_element(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
            return a.score != b.score ? a.score < b.score : a.unseen > b.unseen;
          });
      *entry = {address, 0, 0};
    }
    entry->score = static_cast<std::int8_t>(std::min<int>(entry->score + 1, kMost));
    entry->unseen = 0;
  }
  for (const TubeAddress address : sites.closed) {
    if (Entry* const entry = find(address)) {
      --entry->score;
      entry->unseen = 0;
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
