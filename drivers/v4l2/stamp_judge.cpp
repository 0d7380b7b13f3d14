#include "drivers/v4l2/stamp_judge.h"

#include <algorithm>
#include <chrono>

namespace tubesight::drivers::v4l2 {
namespace {

using core::FieldTime;

/// How long a buffer may have waited to be taken: more than all buffers together hold.
constexpr FieldTime kOldest = std::chrono::seconds(2);
/// A stamp of the same clock is not ahead of it; this much for a driver that rounds.
constexpr FieldTime kAhead = std::chrono::milliseconds(5);

}  // namespace

void StampJudge::begin(const FieldTiming& timing, FieldTime now) {
  timing_ = timing;
  begin_ = now;
  last_stamp_ = FieldTime{INT64_MIN};
  last_told_ = FieldTime{0};
  wrong_in_a_row_ = 0;
  distrusted_ = false;
}

/// The last line comes a field's time after the last field's exposure has ended.
FieldTime StampJudge::mid_of_first(StampKind kind, FieldTime stamp) const {
  if (kind == StampKind::kStartOfExposure) {
    return stamp + timing_.exposure / 2;
  }
  return stamp - timing_.fields_a_buffer * timing_.span - timing_.exposure / 2;
}

/// A clock that goes on and says that the picture waited too long, or that it was exposed before
/// the stream began. Zero, and a stamp that stands still, say nothing of the picture's age.
bool StampJudge::old(FieldTime stamp, FieldTime arrival) const {
  return stamp > last_told_ && (stamp < begin_ || stamp < arrival - kOldest);
}

bool StampJudge::plausible(FieldTime stamp, FieldTime arrival) const {
  return stamp > last_stamp_ && stamp >= begin_ && stamp >= arrival - kOldest &&
         stamp <= arrival + kAhead;
}

StampJudge::Judged StampJudge::judge(StampKind kind, FieldTime stamp, FieldTime arrival) {
  Judged judged;
  judged.wrong = kind != StampKind::kUnknown && old(stamp, arrival);
  judged.by_arrival = !judged.wrong && (distrusted_ || kind == StampKind::kUnknown);
  last_told_ = stamp;
  if (!judged.by_arrival && !judged.wrong) {
    if (plausible(stamp, arrival)) {
      wrong_in_a_row_ = 0;
      last_stamp_ = stamp;
    } else {
      judged.wrong = true;
      distrusted_ = ++wrong_in_a_row_ >= kMostWrong;
    }
  }
  judged.mid_exposure = judged.by_arrival || judged.wrong
                            ? mid_of_first(StampKind::kEndOfFrame, arrival)
                            : mid_of_first(kind, stamp);
  const FieldTime earliest =
      last_ == FieldTime{INT64_MIN} ? judged.mid_exposure : last_ + FieldTime{1};
  judged.mid_exposure = std::max(judged.mid_exposure, earliest);
  last_ = judged.mid_exposure + (timing_.fields_a_buffer - 1) * timing_.span;
  return judged;
}

}  // namespace tubesight::drivers::v4l2
