#include "board/bench/output/progress_line.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <unistd.h>

namespace tubesight::board {
namespace {

constexpr std::chrono::milliseconds kBeforeFirst{500};
constexpr std::chrono::milliseconds kBetween{250};

}  // namespace

bool ProgressLine::due(Clock::time_point now) {
  if (!shown_) {
    return false;
  }
  if (!next_) {
    begun_ = now;
    next_ = now + kBeforeFirst;
  }
  if (now < *next_) {
    return false;
  }
  next_ = now + kBetween;
  return true;
}

std::string share_words(double done, ProgressLine::Clock::duration passed) {
  const double passed_s = std::chrono::duration<double>(passed).count();
  if (done <= 0.0 || passed_s < 1.0) {
    return {};
  }
  const double whole = std::min(done, 1.0);
  constexpr double kLongest_s = 359'999.0;  // 99:59:59
  const auto left = static_cast<long>(std::min(passed_s * (1.0 - whole) / whole, kLongest_s) + 0.5);
  constexpr long kMinute = 60;
  constexpr long kHour = 3600;
  std::array<char, 60> text{};
  if (left >= kHour) {
    std::snprintf(text.data(), text.size(), "%.0f %%, %ld:%02ld:%02ld left",
                  std::floor(100.0 * whole), left / kHour, left % kHour / kMinute, left % kMinute);
  } else {
    std::snprintf(text.data(), text.size(), "%.0f %%, %ld:%02ld left", std::floor(100.0 * whole),
                  left / kMinute, left % kMinute);
  }
  return text.data();
}

void ProgressLine::update(Clock::time_point now, std::int64_t fields, core::FieldTime time,
                          double done) {
  if (!due(now)) {
    return;
  }
  std::array<char, 80> text{};
  const double seconds = std::chrono::duration<double>(time).count();
  std::snprintf(text.data(), text.size(), "%lld fields, %.1f s of the recording",
                static_cast<long long>(fields), seconds);
  const std::string share = share_words(done, now - *begun_);
  write(share.empty() ? std::string(text.data()) : std::string(text.data()) + ", " + share);
}

void ProgressLine::update(Clock::time_point now, std::string_view words) {
  if (due(now)) {
    write(words.substr(0, 79));
  }
}

void ProgressLine::write(std::string_view words) {
  // Padded to what stood there, so that a shorter text leaves nothing of a longer one.
  const int count =
      std::fprintf(stream_, "\r%-*.*s", static_cast<int>(std::min<std::size_t>(width_, 79)),
                   static_cast<int>(words.size()), words.data());
  std::fflush(stream_);
  width_ = count > 1 ? static_cast<std::size_t>(count - 1) : 0;
}

void ProgressLine::erase() {
  if (width_ > 0) {
    std::fprintf(stream_, "\r%*s\r", static_cast<int>(width_), "");
    std::fflush(stream_);
    width_ = 0;
  }
}

bool standard_error_is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

}  // namespace tubesight::board
