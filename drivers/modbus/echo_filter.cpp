#include "drivers/modbus/echo_filter.h"

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "core/base/assert.h"

namespace tubesight::drivers {
namespace {

constexpr std::size_t kAround = 3;  // unit and check sum

// A write that comes back late, of which nobody else has said a word, goes round so often.
constexpr std::int32_t kMostSame = 3;
constexpr core::FieldTime kLatestEcho = std::chrono::milliseconds(100);

}  // namespace

void EchoFilter::expect(const RtuFrame& answer, core::FieldTime soonest) {
  answer_ = answer;
  soonest_ = soonest;
  held_.clear();
  compares_ = true;
  waits_for_frame_ = true;
  passed_ = 0;
}

EchoFilter::Byte EchoFilter::take(std::uint8_t byte, core::FieldTime arrival) {
  if (!compares_) {
    held_.clear();
  }
  const bool fits = held_.try_push_back(byte);
  TUBESIGHT_ASSERT(fits);
  if (compares_ && byte == answer_[held_.size() - 1]) {
    if (held_.size() < answer_.size()) {
      return Byte::kHeld;
    }
    const bool echo = comes_as_echo(arrival);
    same_ = echo ? 0 : std::min(same_ + 1, kMostSame);
    if (echo) {
      if (answer_[1] != kWriteOneFunction) {
        line_ = Line::kEchoes;
      }
      compares_ = false;
      waits_for_frame_ = false;
      return Byte::kEcho;
    }
  } else if (compares_) {
    same_ = 0;
  }
  let_go();
  return Byte::kOther;
}

bool EchoFilter::is_echo(std::span<const std::uint8_t> request, core::FieldTime arrival) {
  if (!waits_for_frame_) {
    return false;
  }
  waits_for_frame_ = false;
  const bool first = static_cast<std::size_t>(passed_) == request.size() + kAround;
  const bool same = std::ranges::equal(
      request, answer_.view().subspan(1, static_cast<std::size_t>(answer_.size()) - kAround));
  if (first && !same) {
    line_ = Line::kDoesNot;  // an echo would have come before
  }
  return same && !first && comes_as_echo(arrival);
}

void EchoFilter::let_go() {
  compares_ = false;
  passed_ = std::min(passed_ + held_.size(), 2 * kMostFrameBytes);
}

bool EchoFilter::comes_as_echo(core::FieldTime arrival) const {
  if (answer_[1] != kWriteOneFunction) {
    return true;  // no request looks like that
  }
  if (line_ != Line::kNew) {
    return line_ == Line::kEchoes;
  }
  return arrival < soonest_ || (same_ == kMostSame && arrival < soonest_ + kLatestEcho);
}

}  // namespace tubesight::drivers
