#include "board/visionbox/log.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace tubesight::board {
namespace {

constexpr double kMostAtOnce = 20.0;
constexpr double kLinesASecond = 0.5;

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return text;
}

}  // namespace

void Log::say_at(const std::string& line, MonotonicTime now) {
  const std::lock_guard lock(mutex_);
  const std::chrono::duration<double> since = now - last_;
  allowance_ = std::min(kMostAtOnce, allowance_ + kLinesASecond * since.count());
  last_ = now;
  if (allowance_ < 1.0) {
    ++untold_;
    ++left_out_;
    return;
  }
  allowance_ -= 1.0;
  if (untold_ > 0) {
    std::fprintf(stderr, "tubesightd: %lld lines left out\n", static_cast<long long>(untold_));
    untold_ = 0;
  }
  std::fprintf(stderr, "tubesightd: %s\n", one_line(line).c_str());
}

std::int64_t Log::left_out() const {
  const std::lock_guard lock(mutex_);
  return left_out_;
}

}  // namespace tubesight::board
