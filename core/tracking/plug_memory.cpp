#include "core/tracking/plug_memory.h"

#include <algorithm>

namespace tubesight::core::tracking {

void PlugMemory::saw_plug(TubeAddress address) {
  const auto known = std::find_if(
      entries_.begin(), end(), [address](const Entry& entry) { return entry.address == address; });
  if (known != end()) {
    known->score = static_cast<std::int8_t>(std::min<int>(known->score + 1, kMost));
    return;
  }
  if (used_ < entries_.size()) {
    entries_[used_++] = {address, 1};
    return;
  }
  *std::min_element(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.score < b.score;
  }) = {address, 1};
}

void PlugMemory::saw_open(TubeAddress address) {
  const auto known = std::find_if(
      entries_.begin(), end(), [address](const Entry& entry) { return entry.address == address; });
  if (known != end() && known->score > 0) {
    --known->score;
  }
}

bool PlugMemory::is_plug(TubeAddress address) const {
  const auto* const last = entries_.data() + used_;
  return std::any_of(entries_.data(), last, [address](const Entry& entry) {
    return entry.score >= kPlugged && entry.address == address;
  });
}

}  // namespace tubesight::core::tracking
