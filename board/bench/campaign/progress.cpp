#include "board/bench/campaign/progress.h"

#include <algorithm>
#include <tuple>

namespace tubesight::board::campaign {

std::int64_t Progress::next_move(std::uint64_t seed, std::int64_t move) const {
  for (const DoneRange& range : ranges_) {
    if (range.seed == seed && range.first <= move && move < range.end) {
      move = range.end;
    }
  }
  return move;
}

void Progress::add(std::uint64_t seed, std::int64_t move, const Counts& counts,
                   std::int64_t busy_ms) {
  auto range = std::find_if(ranges_.begin(), ranges_.end(), [&](const DoneRange& done) {
    return done.seed == seed && done.end == move;
  });
  if (range == ranges_.end()) {
    DoneRange fresh;
    fresh.seed = seed;
    fresh.first = move;
    fresh.end = move;
    range = ranges_.insert(ranges_.end(), fresh);
  }
  range->strata[static_cast<std::size_t>(stratum_of_move(move))] += counts;
  range->busy_ms += busy_ms;
  range->end = move + 1;
  join_neighbours();
}

void Progress::join_neighbours() {
  std::sort(ranges_.begin(), ranges_.end(), [](const DoneRange& a, const DoneRange& b) {
    return std::tie(a.seed, a.first) < std::tie(b.seed, b.first);
  });
  for (std::size_t i = 1; i < ranges_.size();) {
    DoneRange& before = ranges_[i - 1];
    const DoneRange& range = ranges_[i];
    if (before.seed != range.seed || before.end != range.first) {
      ++i;
      continue;
    }
    before.end = range.end;
    before.busy_ms += range.busy_ms;
    for (std::size_t s = 0; s < before.strata.size(); ++s) {
      before.strata[s] += range.strata[s];
    }
    ranges_.erase(ranges_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

bool Progress::absorb(const Progress& other, std::string& why) {
  if (!(other.identity_ == identity_)) {
    why = "it is of box " + other.identity_.box + " and configuration " +
          other.identity_.configuration + ", expected " + identity_.box + " and " +
          identity_.configuration;
    return false;
  }
  for (const DoneRange& theirs : other.ranges_) {
    for (const DoneRange& ours : ranges_) {
      if (ours.seed == theirs.seed && ours.first < theirs.end && theirs.first < ours.end) {
        why = "move " + std::to_string(std::max(ours.first, theirs.first)) + " of seed " +
              std::to_string(ours.seed) + " is in two files, expected each move once";
        return false;
      }
    }
  }
  ranges_.insert(ranges_.end(), other.ranges_.begin(), other.ranges_.end());
  join_neighbours();
  return true;
}

StrataCounts Progress::strata() const {
  StrataCounts sums{};
  for (const DoneRange& range : ranges_) {
    for (std::size_t s = 0; s < sums.size(); ++s) {
      sums[s] += range.strata[s];
    }
  }
  return sums;
}

Counts Progress::total() const {
  Counts sum;
  for (const Counts& counts : strata()) {
    sum += counts;
  }
  return sum;
}

std::int64_t Progress::busy_ms() const {
  std::int64_t sum = 0;
  for (const DoneRange& range : ranges_) {
    sum += range.busy_ms;
  }
  return sum;
}

}  // namespace tubesight::board::campaign
