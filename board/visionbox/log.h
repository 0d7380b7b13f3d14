#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>

#include "board/visionbox/source_clock.h"

namespace tubesight::board {

/// How much a line matters: syslog's numbers.
enum class LogLevel : std::uint8_t { kCritical = 2, kError = 3, kWarning = 4, kInfo = 6 };

/// What a line that says nothing else matters, by its words: what stands still, is gone, cannot be
/// done, or is bad, is a warning or an error.
[[nodiscard]] LogLevel level_of(std::string_view line);

/// Lines for a person, to standard error; to the journal with the level before each, as systemd
/// reads it ("<4>").
///
/// Whatever goes wrong again and again is told a few times, and then now and then with the number
/// of times that it was said meanwhile; lines that differ in numbers alone count as the same. All
/// lines together are bounded, too: what is left out is counted. Any thread but the one that
/// tracks.
class Log {
 public:
  /// To the journal where standard error leads there (JOURNAL_STREAM).
  Log();
  explicit Log(bool to_journal) : to_journal_(to_journal) {}

  void say(const std::string& line) { say_at(line, monotonic_now()); }

  /// The same with the present given: what say() does.
  void say_at(const std::string& line, MonotonicTime now);

  /// Tells of what was said again and again how often, once its time is over. To be called now and
  /// then; say() does it, too.
  void tell_repeats(MonotonicTime now);

  /// Lines left out so far.
  [[nodiscard]] std::int64_t left_out() const;

 private:
  /// A line that was said, and how often since.
  struct Said {
    std::string kind;  ///< without its numbers; empty: none
    std::string line;  ///< as it was said last
    MonotonicTime since{0};
    std::int64_t times = 0;   ///< within its time
    std::int64_t untold = 0;  ///< of these
  };

  [[nodiscard]] Said& remembered(const std::string& line, MonotonicTime now);
  void tell_repeat(Said& said, MonotonicTime now);
  [[nodiscard]] bool allowed(MonotonicTime now);
  void print(const std::string& line);

  bool to_journal_;
  mutable std::mutex mutex_;
  double allowance_ = 20.0;  ///< lines that may still be said at once
  MonotonicTime last_{0};
  std::int64_t untold_ = 0;  ///< left out since the last line
  std::int64_t left_out_ = 0;
  std::array<Said, 32> said_;
};

/// Whether standard error leads to the journal.
[[nodiscard]] bool stderr_is_journal();

}  // namespace tubesight::board
