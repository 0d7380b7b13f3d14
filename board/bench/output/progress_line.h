#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string_view>

#include "core/base/field.h"

namespace tubesight::board {

/// Tells on a terminal how far a long job has come, in one line that is written over and at last
/// erased.
class ProgressLine {
 public:
  using Clock = std::chrono::steady_clock;

  /// Writes to `stream`; nothing at all unless `shown`.
  ProgressLine(std::FILE* stream, bool shown) : stream_(stream), shown_(shown) {}
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { erase(); }

  /// Says that `fields` fields up to the recorded time `time` are done. Writes four times a second
  /// at most, for the first time after half a second: short jobs show nothing.
  void update(Clock::time_point now, std::int64_t fields, core::FieldTime time);
  /// The same of any job, in its own words.
  void update(Clock::time_point now, std::string_view words);

  /// Erases the line, before other text goes to the terminal.
  void erase();

 private:
  [[nodiscard]] bool due(Clock::time_point now);
  void write(std::string_view words);

  std::FILE* stream_;
  bool shown_;
  std::size_t width_ = 0;  ///< characters that stand on the terminal
  std::optional<Clock::time_point> next_;
};

/// Whether standard error is a terminal.
[[nodiscard]] bool standard_error_is_terminal();

}  // namespace tubesight::board
