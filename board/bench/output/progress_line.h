#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/field.h"

namespace tubesight::board {

/// Tells on a terminal how far a long job has come, in one line that is written over and at last
/// erased. One thread uses it, or several one after the other.
class ProgressLine {
 public:
  using Clock = std::chrono::steady_clock;

  /// Writes to standard error where that is a terminal, and not with `-q`.
  ProgressLine();
  /// Writes to `stream`; nothing at all unless `shown`.
  ProgressLine(std::FILE* stream, bool shown) : stream_(stream), shown_(shown) {}
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { erase(); }

  /// Says that `fields` fields up to the recorded time `time` are done, and that this is the share
  /// `done` of the job, 0..1, with the time that is left at this pace; below 0 nobody knows, and
  /// the pace stands there. Writes four times a second at most, for the first time after half a
  /// second: short jobs show nothing.
  void update(Clock::time_point now, std::int64_t fields, core::FieldTime time, double done = -1.0);
  /// The same of any job, in its own words; the share and the time left stand behind them.
  void update(Clock::time_point now, std::string_view words, double done = -1.0);

  /// Erases the line, before other text goes to the terminal.
  void erase();
  /// Erases the one that stands on the terminal, whosever it is.
  static void erase_shown();

  /// Whether anything is ever written: what costs time to find out need not be.
  [[nodiscard]] bool shown() const { return shown_; }

 private:
  [[nodiscard]] bool due(Clock::time_point now);
  void write(std::string_view words, const std::string& share);

  std::FILE* stream_;
  bool shown_;
  std::size_t width_ = 0;  ///< characters that stand on the terminal
  std::optional<Clock::time_point> begun_;
  std::optional<Clock::time_point> next_;
};

/// "42 %, 0:35 left": what a job of which the share `done` took `passed` has before it. Empty while
/// nobody can tell: nothing is done, or it was for less than a second.
[[nodiscard]] std::string share_words(double done, ProgressLine::Clock::duration passed);

/// Whether standard error is a terminal.
[[nodiscard]] bool standard_error_is_terminal();

}  // namespace tubesight::board
