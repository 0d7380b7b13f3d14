#include "board/bench/output/progress_line.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <unistd.h>

#include "board/bench/output/text_output.h"

namespace tubesight::board {
namespace {

constexpr std::chrono::milliseconds kBeforeFirst{500};
constexpr std::chrono::milliseconds kBetween{250};
/// What a line of a terminal holds.
constexpr std::size_t kMostColumns = 79;

ProgressLine* on_terminal = nullptr;

}  // namespace

ProgressLine::ProgressLine()
    : ProgressLine(stderr, standard_error_is_terminal() && talk() != Talk::kQuiet) {}

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
  const int length = std::snprintf(text.data(), text.size(), "%lld fields, %.1f s of the recording",
                                   static_cast<long long>(fields), seconds);
  const double passed_s = std::chrono::duration<double>(now - *begun_).count();
  if (done < 0.0 && passed_s >= 1.0) {
    std::snprintf(text.data() + length, text.size() - static_cast<std::size_t>(length),
                  ", %.0f fields a second", static_cast<double>(fields) / passed_s);
  }
  write(text.data(), share_words(done, now - *begun_));
}

void ProgressLine::update(Clock::time_point now, std::string_view words, double done) {
  if (due(now)) {
    write(words, share_words(done, now - *begun_));
  }
}

void ProgressLine::write(std::string_view words, const std::string& share) {
  const std::string behind = share.empty() ? "" : ", " + share;
  std::string line(words.substr(0, kMostColumns - std::min(kMostColumns, behind.size())));
  line += behind;
  if (on_terminal != this) {
    erase_shown();
    on_terminal = this;
  }
  // Padded to what stood there, so that a shorter text leaves nothing of a longer one.
  const int count = std::fprintf(stream_, "\r%-*s",
                                 static_cast<int>(std::min(width_, kMostColumns)), line.c_str());
  std::fflush(stream_);
  width_ = count > 1 ? static_cast<std::size_t>(count - 1) : 0;
}

void ProgressLine::erase_shown() {
  if (on_terminal != nullptr) {
    on_terminal->erase();
  }
}

void ProgressLine::erase() {
  on_terminal = on_terminal == this ? nullptr : on_terminal;
  if (width_ > 0) {
    std::fprintf(stream_, "\r%*s\r", static_cast<int>(width_), "");
    std::fflush(stream_);
    width_ = 0;
  }
}

bool standard_error_is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

}  // namespace tubesight::board
