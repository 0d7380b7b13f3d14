#pragma once

#include <cstdint>
#include <mutex>
#include <string>

#include "board/visionbox/source_clock.h"

namespace tubesight::board {

/// Lines for a person, to standard error. Whatever goes wrong again and again is told a few times,
/// and then now and then with the number of lines left out. Any thread but the one that tracks.
class Log {
 public:
  void say(const std::string& line) { say_at(line, monotonic_now()); }

  /// The same with the present given: what say() does.
  void say_at(const std::string& line, MonotonicTime now);

  /// Lines left out so far.
  [[nodiscard]] std::int64_t left_out() const;

 private:
  mutable std::mutex mutex_;
  double allowance_ = 20.0;  ///< lines that may still be said at once
  MonotonicTime last_{0};
  std::int64_t untold_ = 0;  ///< left out since the last line
  std::int64_t left_out_ = 0;
};

}  // namespace tubesight::board
