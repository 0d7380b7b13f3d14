#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "board/visionbox/source_clock.h"

namespace tubesight::board {

/// The threads without which the box is no box: none may stand still.
enum class Part : std::uint8_t {
  kTracking,  ///< judges fields, or says that none came
  kLink,      ///< answers the robot
  kLamp,      ///< keeps the lamp at its level
  kDesk,      ///< opens, looks after, and answers people
};
inline constexpr std::size_t kParts = 4;

/// How often each part has come round so far; below 0: it is not there.
using Beats = std::array<std::int64_t, kParts>;

/// Finds out which parts stand still. Asks no clock.
class LifeSigns {
 public:
  /// The slowest source makes a turn in two seconds; nothing else takes a tenth of it.
  static constexpr MonotonicTime kStuckAfter = std::chrono::seconds(3);

  /// Takes the beats of a moment. A part is given its time from the first look on.
  void look(const Beats& beats, MonotonicTime now);

  /// Whether every part that is there has come round within kStuckAfter.
  [[nodiscard]] bool alive() const { return stuck_.empty(); }
  /// Those that have not, for a person: "the tracking, the link"; empty: none.
  [[nodiscard]] const std::string& stuck() const { return stuck_; }

 private:
  struct Seen {
    std::int64_t beats = -1;
    MonotonicTime since{0};
  };
  std::array<Seen, kParts> seen_{};
  std::string stuck_;
};

}  // namespace tubesight::board
