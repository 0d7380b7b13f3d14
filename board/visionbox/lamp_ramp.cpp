#include "board/visionbox/lamp_ramp.h"

#include <algorithm>

namespace tubesight::board {
namespace {

constexpr std::int64_t kMillionthsAPermille = 1000;
constexpr std::int64_t kFull_millionth = 1'000'000;

}  // namespace

void LampRamp::begin(MonotonicTime now) {
  last_ = now;
  level_millionth_ = 0;
}

std::int32_t LampRamp::next(std::int32_t wanted_permille, MonotonicTime now) {
  const MonotonicTime since = std::max(now - last_, MonotonicTime{0});
  last_ = now;
  const std::int64_t rest = care_.rest_permille * kMillionthsAPermille;
  if (care_.full_for > std::chrono::seconds(0)) {
    spent_ = level_millionth_ > rest ? spent_ + since : std::max(MonotonicTime{0}, spent_ - since);
    resting_ = spent_ >= care_.full_for || (resting_ && spent_ > MonotonicTime{0});
  }
  std::int64_t to = wanted_permille * kMillionthsAPermille;
  if (resting_) {
    to = std::min(to, rest);
  }
  if (care_.soft <= std::chrono::milliseconds(0)) {
    level_millionth_ = to;
  } else {
    using Microseconds = std::chrono::microseconds;
    const std::int64_t step = since >= care_.soft
                                  ? kFull_millionth
                                  : kFull_millionth *
                                        std::chrono::duration_cast<Microseconds>(since).count() /
                                        Microseconds(care_.soft).count();
    level_millionth_ = std::clamp(to, level_millionth_ - step, level_millionth_ + step);
  }
  return static_cast<std::int32_t>(level_millionth_ / kMillionthsAPermille);
}

}  // namespace tubesight::board
