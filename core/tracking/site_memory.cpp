#include "core/tracking/site_memory.h"

#include <cstdlib>

namespace tubesight::core::tracking {

// Marks it as in view.
bool SiteMemory::is_known(Short site) {
  const auto* const found = std::find(known_.begin(), known_.end(), site);
  if (found == known_.end()) {
    return false;
  }
  in_view_ |= std::uint64_t{1} << static_cast<unsigned>(found - known_.begin());
  return true;
}

void SiteMemory::saw_tube_end(TubeAddress address) {
  const Short site = short_of(address);
  if (!is_known(site) && known_.try_push_back(site)) {
    in_view_ |= std::uint64_t{1} << static_cast<unsigned>(known_.size() - 1);
  }
  auto* const found = std::find(closed_.begin(), closed_.end(), site);
  if (found != closed_.end()) {
    *found = closed_[closed_.size() - 1];
    closed_.truncate(closed_.size() - 1);
  }
}

void SiteMemory::saw_closed(TubeAddress address, bool clear, TubeAddress tool) {
  const Short site = short_of(address);
  if (is_known(site) || !clear || has(closed_, site) || closed_.try_push_back(site)) {
    return;
  }
  const auto steps = [tool](Short from) {
    return std::max(std::abs(from.row - tool.row), std::abs(from.column - tool.column));
  };
  auto* const farthest = std::max_element(
      closed_.begin(), closed_.end(), [&steps](Short a, Short b) { return steps(a) < steps(b); });
  if (steps(site) < steps(*farthest)) {
    *farthest = site;
  }
}

// Forgets those out of view where the next field might find no room.
void SiteMemory::end_field() {
  constexpr std::int32_t kRoomy = 44;
  std::int32_t kept = known_.size();
  if (known_.size() > kRoomy) {
    kept = 0;
    for (std::int32_t i = 0; i < known_.size(); ++i) {
      if (((in_view_ >> static_cast<unsigned>(i)) & 1U) != 0) {
        known_[kept++] = known_[i];
      }
    }
  }
  known_.truncate(kept);
  in_view_ = 0;
}

}  // namespace tubesight::core::tracking
