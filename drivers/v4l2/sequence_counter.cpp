#include "drivers/v4l2/sequence_counter.h"

namespace tubesight::drivers::v4l2 {
namespace {

/// Fields that may be lost in one gap: beyond these the counter is another one.
constexpr std::int64_t kLongestGap = 100'000;

}  // namespace

void SequenceCounter::begin_anew(BufferKind kind) {
  kind_ = kind;
  known_ = false;
  counts_ = false;
  pair_ = false;
  shared_ = false;
}

/// Two fields of one number tell that frames are counted, and which field is the first; but only of
/// a counter that moves at all.
void SequenceCounter::look_for_pairs(bool moved, bool odd) {
  const bool pair = !moved && odd != odd_;
  if (!shared_ && ((counts_ && pair) || (moved && pair_))) {
    shared_ = true;
    odd_first_ = pair ? odd_ : !odd_;
  }
  pair_ = pair;
}

/// From the last buffer to this one, in fields.
std::int64_t SequenceCounter::advance(std::uint32_t number, bool odd) const {
  const std::int64_t counted = static_cast<std::int32_t>(number - number_);  // modulo 2^32
  if (!shared_) {
    return counted * usual();
  }
  return 2 * counted + (odd != odd_first_ ? 1 : 0) - (odd_ != odd_first_ ? 1 : 0);
}

SequenceCounter::Step SequenceCounter::next(std::uint32_t number, bool odd) {
  Step step;
  std::int64_t by = usual();
  if (!known_) {
    by = began_ ? kNewBeginning : 0;
  } else {
    const bool moved = number != number_;
    if (kind_ == BufferKind::kOneField) {
      look_for_pairs(moved, odd);
    }
    counts_ = counts_ || moved;
    if (counts_) {
      by = advance(number, odd);
      step.repeated = by == 0;
      step.went_back = by < 0 || by > kLongestGap;
      step.lost = step.repeated || step.went_back ? 0 : by - usual();
      by = step.repeated ? usual() : step.went_back ? kNewBeginning : by;
    }
  }
  began_ = true;
  known_ = true;
  number_ = number;
  odd_ = odd;
  sequence_ += by;
  step.sequence = sequence_;
  return step;
}

}  // namespace tubesight::drivers::v4l2
