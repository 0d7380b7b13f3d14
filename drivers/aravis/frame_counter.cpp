#include "drivers/aravis/frame_counter.h"

namespace tubesight::drivers::aravis {
namespace {

/// The largest number of a counter of 16 bits, which leaves 0 out.
constexpr std::uint64_t kLargest16 = 65'535;
/// Frames around the wrap that may be lost in one gap; beyond these the counter begins anew.
constexpr std::uint64_t kAroundWrap = 5'000;
/// The same of any gap.
constexpr std::int64_t kLongestGap = 100'000;

}  // namespace

/// From the last frame to this one; negative where the counter went back.
std::int64_t FrameCounter::advance(std::uint64_t id) const {
  if (id >= id_) {
    const std::uint64_t by = id - id_;
    return by > static_cast<std::uint64_t>(kLongestGap) ? -1 : static_cast<std::int64_t>(by);
  }
  const bool wraps = id_ <= kLargest16 && id_ > kLargest16 - kAroundWrap && id < kAroundWrap;
  if (!wraps) {
    return -1;
  }
  // One that says 0 at the wrap has one number more.
  return static_cast<std::int64_t>(kLargest16 - id_ + id) + (id == 0 ? 1 : 0);
}

FrameCounter::Step FrameCounter::next(std::uint64_t id) {
  Step step;
  std::int64_t by = 1;
  if (!known_) {
    by = began_ ? kNewBeginning : 0;
  } else {
    counts_ = counts_ || id != id_;
    if (counts_) {
      by = advance(id);
      step.repeated = by == 0;
      step.went_back = by < 0;
      step.lost = by > 0 ? by - 1 : 0;
      by = step.repeated ? 1 : step.went_back ? kNewBeginning : by;
    }
  }
  began_ = true;
  known_ = true;
  id_ = id;
  sequence_ += by;
  step.sequence = sequence_;
  return step;
}

}  // namespace tubesight::drivers::aravis
